#include "scene/builtin.h"

#include "base/error.h"
