// A file that exists as long as the object.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace rois::test {

class TemporaryFile {
public:
    explicit TemporaryFile(std::string const& text)
        : path_{std::filesystem::temp_directory_path() / ("rois-main-" + std::to_string(getpid()))} {
        std::ofstream{path_} << text;
    }
    ~TemporaryFile() { std::filesystem::remove(path_); }
    TemporaryFile(TemporaryFile const&) = delete;
    TemporaryFile& operator=(TemporaryFile const&) = delete;

    std::string name() const { return path_; }

private:
    std::filesystem::path path_;
};

}  // namespace rois::test
