#include "base/revision.h"

#include <atomic>

namespace bruma {

Revision next_revision() {
    static std::atomic<Revision> newest{0};
    return ++newest;
}

}  // namespace bruma
