#include "journal/step_mark.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <charconv>
#include <cstring>
#include <string_view>
#include <utility>

#include "types/text/to_number.hpp"

namespace rois::journal {

namespace {

constexpr std::size_t digits_of_journal = 32, longest_number = 20;

}  // namespace

StepMark::StepMark(std::string name) : name_{std::move(name)} {
    std::array<char, digits_of_journal + 1 + longest_number> found{};
    UniqueDescriptor const file{::open(name_.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC)};
    auto const size = ::pread(file.get(), found.data(), found.size(), 0);
    std::string_view const text{found.data(), static_cast<std::size_t>(size < 0 ? 0 : size)};
    auto const number =
        text.size() > digits_of_journal ? to_number<std::uint64_t>(text.substr(digits_of_journal + 1)) : std::nullopt;
    if (number) left_ = Step{.journal = std::string{text.substr(0, digits_of_journal)}, .number = *number};
}

void StepMark::set(Step const& step) noexcept {
    if (file_.get() < 0)
        file_ = UniqueDescriptor{::open(name_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, S_IRUSR | S_IWUSR)};
    if (file_.get() < 0 || step.journal.size() != digits_of_journal) return;
    std::array<char, digits_of_journal + 1 + longest_number> text{};
    std::memcpy(text.data(), step.journal.data(), digits_of_journal);
    text[digits_of_journal] = ' ';
    auto const end = std::to_chars(text.data() + digits_of_journal + 1, text.data() + text.size(), step.number).ptr;
    if (::pwrite(file_.get(), text.data(), static_cast<std::size_t>(end - text.data()), 0) < 0) file_ = {};
}

void StepMark::remove() noexcept { ::unlink(name_.c_str()); }

}  // namespace rois::journal
