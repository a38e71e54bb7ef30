// Finds damage in SQLite's log, the WAL file (https://www.sqlite.org/fileformat2.html#walformat).
#pragma once

namespace rois::journal {

// Each step ends with a commit, and is on the disk before the next one is written. So behind a place that cannot be read there
// may be the commit of one step, which a crash has cut short. Two of them prove that the place was damaged later. Damage in the
// last two steps cannot be found. `file`: open for reading. Returns false if the file cannot be read.
bool is_damaged_log(int file);

}  // namespace rois::journal
