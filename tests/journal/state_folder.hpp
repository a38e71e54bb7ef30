// A folder for the journal of a gateway.
#pragma once

#include <stdlib.h>

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

namespace rois::test {

// Removed at the end.
class StateFolder {
public:
    StateFolder() {
        if (::mkdtemp(name_.data()) == nullptr) throw std::runtime_error{"cannot make a folder"};
    }
    ~StateFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(name_, ignored);
    }
    StateFolder(StateFolder const&) = delete;
    StateFolder& operator=(StateFolder const&) = delete;

    std::string const& name() const { return name_; }
    std::string file() const { return name_ + "/journal.db"; }
    // The bytes of all files in it.
    std::uintmax_t bytes() const {
        std::uintmax_t sum = 0;
        for (auto const& entry : std::filesystem::directory_iterator{name_}) {
            std::error_code gone;
            auto const size = entry.file_size(gone);
            if (!gone) sum += size;
        }
        return sum;
    }
    std::vector<std::string> arguments() const { return {"--state", name_}; }

private:
    std::string name_ = "/tmp/rois-state-XXXXXX";
};

}  // namespace rois::test
