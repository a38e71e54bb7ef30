#include "types/unique_descriptor.hpp"

#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace rois {

UniqueDescriptor::~UniqueDescriptor() {
    if (number_ >= 0) ::close(number_);
}

void write_all(UniqueDescriptor const& file, std::string_view text) {
    while (!text.empty()) {
        auto const written = ::write(file.get(), text.data(), text.size());
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) throw std::system_error{errno, std::system_category()};
        text.remove_prefix(static_cast<std::size_t>(written));
    }
}

}  // namespace rois
