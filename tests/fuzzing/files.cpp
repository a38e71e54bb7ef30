#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <stdexcept>
#include <string>

#include "fuzzing/targets.hpp"
#include "main/choosing_section.hpp"
#include "main/configuration_file.hpp"
#include "main/engines_file.hpp"
#include "main/settings.hpp"
#include "main/tokens_file.hpp"
#include "types/unique_descriptor.hpp"

namespace rois::fuzzing {

namespace {

// Calls `read` with the name of a file that holds the input. A refusal must be one line.
template <class Read>
void with_file(std::string_view input, Read const& read) {
    UniqueDescriptor const file{::memfd_create("fuzzing", MFD_CLOEXEC)};
    if (file.get() < 0 || ::write(file.get(), input.data(), input.size()) != static_cast<ssize_t>(input.size()) ||
        ::fchmod(file.get(), S_IRUSR | S_IWUSR) != 0)
        throw std::runtime_error{"no file in memory"};
    try {
        read("/proc/self/fd/" + std::to_string(file.get()));
    } catch (BadSettings const& refused) {
        if (std::string_view{refused.what()}.find('\n') != std::string_view::npos)
            throw std::logic_error{std::string{"the refusal has several lines: "} + refused.what()};
    }
}

}  // namespace

void configuration(std::string_view input) {
    with_file(input, [](std::string const& file) {
        GatewaySettings settings;
        read_configuration_file(file, settings);
        static_cast<void>(commented_configuration(settings));
    });
}

void engines(std::string_view input) {
    with_file(input, [](std::string const& file) { static_cast<void>(read_choosing(file, read_engines_file(file))); });
}

void tokens(std::string_view input) {
    with_file(input, [](std::string const& file) { static_cast<void>(table_of(read_tokens(file), {})); });
}

}  // namespace rois::fuzzing
