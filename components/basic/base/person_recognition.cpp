#include "basic/base/person_recognition.hpp"

#include <algorithm>
#include <utility>

#include "basic/base/codebooks.hpp"

namespace rois::basic {

void PersonRecognition::sense(Instant when) {
    std::erase_if(reported_, [&](auto const& track) { return !perception().find(track, codebook::track); });
    std::vector<RecognizedPerson> news;
    std::vector<std::string> names;
    for (auto& person : perception().recognized()) {
        auto name = name_of(person);
        if (!name || !reported_.insert(person.track).second) continue;
        names.push_back(std::move(*name));
        news.push_back(std::move(person));
    }
    if (news.empty()) return;
    Results results;
    auto const seen = perception().sightings(Sense::people);
    for (std::size_t i = 0; i < news.size(); ++i) {
        auto const sighting = std::ranges::find(seen, news[i].who, &Sighting::who);
        if (sighting == seen.end()) continue;
        results.located.push_back(located_entity("person_ref", names[i], sighting->pose, sighting->height, sighting->covariance));
    }
    results.parameters = {date_time("timestamp", when.utc), references("person_ref", std::move(names), std::string{codebook_})};
    describe(news, results.parameters);
    port().event(event_type_, std::move(results));
}

}  // namespace rois::basic
