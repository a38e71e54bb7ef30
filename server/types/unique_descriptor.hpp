// Owns a file descriptor of the system.
#pragma once

#include <string_view>
#include <utility>

namespace rois {

class UniqueDescriptor {
public:
    UniqueDescriptor() = default;
    explicit UniqueDescriptor(int number) : number_{number} {}
    UniqueDescriptor(UniqueDescriptor&& other) noexcept : number_{other.release()} {}
    UniqueDescriptor& operator=(UniqueDescriptor&& other) noexcept {
        std::swap(number_, other.number_);
        return *this;
    }
    ~UniqueDescriptor();  // closes it

    int get() const { return number_; }  // negative: none
    int release() { return std::exchange(number_, -1); }

private:
    int number_ = -1;
};

// Throws std::system_error after a part of the text, if the system does not take all of it.
void write_all(UniqueDescriptor const&, std::string_view text);

}  // namespace rois
