// Several things of which each must be tried, whatever becomes of the others.
#pragma once

#include <exception>
#include <utility>

namespace rois {

class Attempts {
public:
    // Does it. Returns false if an exception left it; the first of these is kept.
    template <class What>
    bool operator()(What const& what) {
        try {
            what();
            return true;
        } catch (...) {
            note(std::current_exception());
        }
        return false;
    }

    void note(std::exception_ptr failure) noexcept {
        if (!failed_) failed_ = std::move(failure);
    }

    std::exception_ptr const& failure() const { return failed_; }  // null: none

    // Throws what was kept, if anything.
    void rethrow() const {
        if (failed_) std::rethrow_exception(failed_);
    }

private:
    std::exception_ptr failed_;
};

}  // namespace rois
