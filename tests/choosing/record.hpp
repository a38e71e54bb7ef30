// What a test notes about the persons whom the first two units of a simulation both sense.
#pragma once

#include <array>
#include <map>
#include <string>

#include "choosing/simulator.hpp"

namespace rois::choosing::stage {

// A root mean square.
class Rms {
public:
    void add(double value) {
        squares_ += value * value;
        ++count_;
    }
    double value() const;  // infinite if there is none
    int count() const { return count_; }

private:
    double squares_ = 0;
    int count_ = 0;
};

// Returns the reported standard deviation, in metres: the geometric mean of both axes of the ellipse.
double deviation_of(FusedPerson const&);

// Errors are distances in metres between a position and the true one.
struct Record {
    // Call it ten times per second, for one world after the other.
    void note(Simulator const&);

    double better_unit_held() const { return std::min(held[0].value(), held[1].value()); }
    std::size_t better_unit() const { return listed[0].value() <= listed[1].value() ? 0 : 1; }
    double coverage() const { return inside / fused.count(); }
    double changes_in_ten_minutes() const { return name_changes / (presence / 600); }

    Rms fused;                          // always
    std::array<Rms, 2> held;            // always; of the last list of each unit
    std::array<Rms, 2> listed;          // at the moments of the lists of each unit
    std::array<Rms, 2> fused_at_lists;  // at the same moments
    double inside = 0;                  // number of true positions within the 95 % ellipse
    Rms deviation;                      // deviation_of()
    int name_changes = 0;
    int shared_names = 0;  // moments at which two persons have one name
    double presence = 0;   // seconds, of all persons together

private:
    std::map<int, std::string> names_;
    double last_time_ = 0;
};

}  // namespace rois::choosing::stage
