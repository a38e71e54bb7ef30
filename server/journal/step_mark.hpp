// The last step of a journal, in a file of its own (docs/journal.md).
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "types/unique_descriptor.hpp"

namespace rois::journal {

struct Step {
    std::string journal;  // the journal that it is of: 32 hexadecimal digits
    std::uint64_t number = 0;
};

// Exists while a gateway runs, or if it did not end in order. Then the next start can tell whether the database and SQLite's log
// have the last step: SQLite does not miss a log that was removed or replaced. Not thread-safe.
class StepMark {
public:
    explicit StepMark(std::string name);

    // What was left by a gateway that did not end in order; nullopt: nothing.
    std::optional<Step> const& left() const { return left_; }

    // To be called when the step is on the disk. If that fails, the mark has an earlier one.
    void set(Step const&) noexcept;
    void remove() noexcept;

private:
    std::string const name_;
    std::optional<Step> left_;
    UniqueDescriptor file_;
};

}  // namespace rois::journal
