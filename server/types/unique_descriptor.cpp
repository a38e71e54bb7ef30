#include "types/unique_descriptor.hpp"

#include <unistd.h>

namespace rois {

UniqueDescriptor::~UniqueDescriptor() {
    if (number_ >= 0) ::close(number_);
}

}  // namespace rois
