#include "choosing/record.hpp"

#include <Eigen/LU>
#include <cmath>
#include <limits>

namespace rois::choosing::stage {
namespace {

constexpr double ellipse95 = 2.4477;  // standard deviations; of two dimensions
constexpr double settling = 3;        // seconds at the beginning that are not noted

}  // namespace

double Rms::value() const { return count_ > 0 ? std::sqrt(squares_ / count_) : std::numeric_limits<double>::infinity(); }

double deviation_of(FusedPerson const& person) { return std::pow(person.covariance.determinant(), 0.25); }

void Record::note(Simulator const& world) {
    if (world.time < last_time_) names_.clear();
    last_time_ = world.time;
    if (world.time < settling) return;
    auto const persons = world.fused();
    std::map<std::string, int> named;
    for (int i = 0; i < static_cast<int>(world.walkers.size()); ++i) {
        presence += 0.1;
        auto const name = world.name_of(i);
        if (!name) continue;
        if (names_.contains(i) && names_[i] != *name) ++name_changes;
        if (++named[*name] > 1) ++shared_names;
        names_[i] = *name;
        FusedPerson const& person = persons.at(*name);
        bool const is_seen_by_both = world.units[0].measured.contains(i) && world.units[1].measured.contains(i);
        if (!is_seen_by_both || person.sensed_by.size() < 2) continue;
        Vector const truth = world.walkers[static_cast<std::size_t>(i)].position;
        Vector const error = person.position - truth;
        fused.add(error.norm());
        deviation.add(deviation_of(person));
        if (deviations(error, person.covariance) <= ellipse95) ++inside;
        for (std::size_t u = 0; u < 2; ++u) {
            double const of_unit = (world.units[u].measured.at(i) - truth).norm();
            held[u].add(of_unit);
            if (world.units[u].listed_at != world.time) continue;
            listed[u].add(of_unit);
            fused_at_lists[u].add(error.norm());
        }
    }
}

}  // namespace rois::choosing::stage
