#include "scene/builtin.h"
