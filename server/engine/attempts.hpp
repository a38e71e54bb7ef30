// Runs several actions, all of them even if some throw.
#pragma once

#include <exception>
#include <utility>

namespace rois {

class Attempts {
public:
    // Runs `what`. Returns false if it throws. Keeps the first exception of all calls.
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

    std::exception_ptr const& failure() const { return failed_; }  // null if nothing failed

    // Throws the kept exception, if there is one.
    void rethrow() const {
        if (failed_) std::rethrow_exception(failed_);
    }

private:
    std::exception_ptr failed_;
};

}  // namespace rois
