#include "command/input/input.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <iterator>

#include "command/exit.hpp"

namespace rois::command {

std::ifstream open_file(std::string const& file) {
    std::error_code unknown;
    if (std::filesystem::is_directory(file, unknown))  // an ifstream would open it and fail later
        throw Trouble{Exit::usage, file + " cannot be read: this is a directory; name a file in it"};
    std::ifstream in{file, std::ios::binary};
    if (!in) throw Trouble{Exit::usage, file + " cannot be read: " + std::strerror(errno)};
    return in;
}

std::string text_of_file(std::string const& file) {
    if (file == "-") return {std::istreambuf_iterator<char>{std::cin}, {}};
    auto in = open_file(file);
    try {
        return {std::istreambuf_iterator<char>{in}, {}};
    } catch (std::ios_base::failure const&) {
        throw Trouble{Exit::usage, file + " cannot be read: " + std::strerror(errno)};
    }
}

}  // namespace rois::command
