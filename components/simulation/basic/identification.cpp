// Person identification (7.6.4): reports the id of a known visitor, once while they are tracked.
#include <algorithm>
#include <set>

#include "simulation/basic/basic_components.hpp"
#include "simulation/basic/codebooks.hpp"
#include "simulation/robot/senses.hpp"

namespace rois::simulation {
namespace {

class Identification final : public ContinuousFunction {
public:
    using ContinuousFunction::ContinuousFunction;

private:
    void begin() override { reported_.clear(); }

    void sense(Instant when) override {
        std::erase_if(reported_, [&](PersonId person) { return !hall().track(person); });
        std::vector<RecognizedPerson> news;
        for (auto& person : people_recognized(hall(), robot()))
            if (person.known && reported_.insert(person.person).second) news.push_back(std::move(person));
        if (!news.empty()) port().event("person_identified", results(news, when));
    }

    Results results(std::vector<RecognizedPerson> const& people, Instant when) const {
        auto const seen = people_seen(hall(), robot());
        std::vector<std::string> ids;
        Results results;
        for (auto const& person : people) {
            ids.push_back(person.ref);
            auto const sighting = std::ranges::find(seen, person.person, &Seen::person);
            if (sighting == seen.end()) continue;
            results.located.push_back(located_entity("person_ref", person.ref, sighting->pose, 0, sighting->covariance));
        }
        results.parameters = {date_time("timestamp", when.utc),
                              references("person_ref", std::move(ids), std::string{codebook::visitor})};
        return results;
    }

    std::set<PersonId> reported_;
};

}  // namespace

std::unique_ptr<Component> person_identification(Context context) { return std::make_unique<Identification>(std::move(context)); }

}  // namespace rois::simulation
