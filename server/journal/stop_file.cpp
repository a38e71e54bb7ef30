#include "journal/stop_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "journal/journal_file.hpp"
#include "types/text/texts.hpp"

namespace rois::journal {

StopFile::StopFile(UniqueDescriptor file, std::string const& name) : file_{std::move(file)} {
    char kept = '0';
    if (::pread(file_.get(), &kept, 1, 0) == 1)
        is_stopped_ = kept == '1';
    else if (::pwrite(file_.get(), &kept, 1, 0) != 1)
        throw BadJournal{"state: cannot write " + rois::quoted(name) + ": " + std::strerror(errno)};
}

bool StopFile::keep(bool is_stopped) noexcept {
    if (is_stopped == is_stopped_) return true;
    if (::pwrite(file_.get(), is_stopped ? "1" : "0", 1, 0) != 1 || ::fdatasync(file_.get()) != 0) return false;
    is_stopped_ = is_stopped;
    return true;
}

}  // namespace rois::journal
