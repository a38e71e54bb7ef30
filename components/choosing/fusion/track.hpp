// One person as one unit senses them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "choosing/fusion/estimate.hpp"
#include "types/instant.hpp"

namespace rois::choosing {

// What is known of one unit.
struct UnitSettings {
    double deviation = 0.1;  // standard deviation of each axis, in metres, for positions without a covariance

    // The longest time between two lists while persons move, with a margin for delays. A unit that is silent for longer says that
    // every person is still within `still_within` metres of their last position. A value that fits to the unit makes positions of
    // persons who stop more exact.
    std::chrono::nanoseconds period = std::chrono::milliseconds{1500};
    double still_within = 0.2;
};

struct Measurement {
    Gaussian position;  // in metres
    Details details{};
};

// Follows one person with a Kalman filter: constant velocity, changed by random accelerations.
//
// The filter treats the errors of a unit as independent from list to list. A part of them is not: a unit that stands 5 cm beside
// its supposed place is always wrong by the same 5 cm. So the covariance in at() is never smaller than that of the last
// measurement, although the filter averages.
class Track {
public:
    Track(std::uint64_t id, int unit, std::string name, UnitSettings const&, Measurement const&, Steady when);

    std::uint64_t id() const { return id_; }  // never used again
    int unit() const { return unit_; }
    std::string const& name() const { return name_; }  // the unit's own name of the person
    Details const& details() const { return details_; }
    Steady measured() const { return measured_; }

    // Whether a walking person can have come from the last position to this one. If not, the unit now means another person.
    bool can_reach(Measurement const&, Steady when) const;

    // Takes the unit's next measurement. `when` is not earlier than the last one.
    void measure(Measurement const&, Steady when);

    // Whether the unit has been silent for longer than its period: the person stands.
    bool stands(Steady when) const { return when - measured_ > settings_.period; }

    // Returns where the person is at `when`, which is not earlier than the last measurement (an earlier time counts as that).
    Estimate at(Steady when) const;

    // Kept by People: the person whom this track belongs to, since when, and since when it has lain apart from them.
    std::uint64_t person = 0;
    Steady joined{};
    std::optional<Steady> apart_since;
    Estimate now;  // at() of the last step

private:
    using State = Eigen::Vector4d;  // position, velocity
    using StateCovariance = Eigen::Matrix4d;
    struct Filter {
        State mean;
        StateCovariance covariance;
    };
    Filter predicted(Steady when) const;

    std::uint64_t id_;
    int unit_;
    std::string name_;
    UnitSettings settings_;
    Filter filter_;
    Matrix reserve_ = Matrix::Zero();  // covariance of the last measurement minus that of the filter; never negative
    Steady measured_;
    Details details_;
};

}  // namespace rois::choosing
