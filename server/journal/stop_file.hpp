// Whether everything is stopped, in a file of its own (docs/journal.md).
#pragma once

#include <string>

#include "types/unique_descriptor.hpp"

namespace rois::journal {

// Its only byte is 1 or 0. It never grows: also a full disk takes a change of it. Not thread-safe.
class StopFile {
public:
    // `file`: open for reading and writing. If it is empty, nothing is stopped. Throws BadJournal if it cannot be written.
    StopFile(UniqueDescriptor file, std::string const& name);

    bool is_stopped() const { return is_stopped_; }

    // Another start of the gateway finds this as soon as the system has taken it, and also after a power cut when this returns.
    // Returns false if that failed.
    bool keep(bool is_stopped) noexcept;

private:
    UniqueDescriptor file_;
    bool is_stopped_ = false;  // as kept
};

}  // namespace rois::journal
