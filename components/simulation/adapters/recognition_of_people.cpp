// Person gender identification and person age recognition (Annex C.2, C.3): report people who are near enough and turned to the
// robot, once while they are tracked.
#include <algorithm>
#include <cmath>
#include <set>

#include "simulation/adapters/example_components.hpp"
#include "simulation/basic/codebooks.hpp"
#include "simulation/robot/senses.hpp"
#include "simulation/world/random.hpp"

namespace rois::simulation {
namespace {

// Reports people when they are first recognized.
class RecognitionOfPeople : public ContinuousFunction {
public:
    using ContinuousFunction::ContinuousFunction;

protected:
    virtual bool can_report(Person const&) const = 0;
    virtual void report(std::vector<Person const*> const& people, Results results) = 0;

private:
    void begin() final { reported_.clear(); }

    void sense(Instant when) final {
        std::erase_if(reported_, [&](PersonId person) { return !hall().track(person); });
        std::vector<Person const*> news;
        std::vector<std::string> refs;
        Results results;
        auto const seen = people_seen(hall(), robot());
        for (auto const& recognized : people_recognized(hall(), robot())) {
            auto const* person = hall().person(recognized.person);
            if (person == nullptr || !can_report(*person) || !reported_.insert(recognized.person).second) continue;
            news.push_back(person);
            refs.push_back(recognized.track);
            auto const sighting = std::ranges::find(seen, recognized.person, &Seen::person);
            if (sighting != seen.end())
                results.located.push_back(
                    located_entity("person_ref", recognized.track, sighting->pose, 0, sighting->covariance));
        }
        if (news.empty()) return;
        results.parameters = {date_time("timestamp", when.utc),
                              references("person_ref", std::move(refs), std::string{codebook::track})};
        report(news, std::move(results));
    }

    std::set<PersonId> reported_;
};

// Writes a list of numbers.
template <class NumberOf>
Parameter numbers(std::string name, std::vector<Person const*> const& people, NumberOf number_of) {
    std::string text;
    for (auto const* person : people) text += (text.empty() ? "" : " ") + std::to_string(number_of(*person));
    return {.name = std::move(name),
            .data_type_ref = {.code = "int[]", .authority = {}, .codebook_ref = {}, .version = {}},
            .values = {std::move(text)}};
}

class GenderIdentification final : public RecognitionOfPeople {
public:
    using RecognitionOfPeople::RecognitionOfPeople;

private:
    bool can_report(Person const&) const override { return true; }

    void report(std::vector<Person const*> const& people, Results results) override {
        results.parameters.push_back(
            numbers("person_gender_code", people, [](Person const& person) { return static_cast<int>(person.gender); }));
        results.parameters.back().data_type_ref.codebook_ref = codebook::gender;
        port().event("person_gender_identified", std::move(results));
    }
};

class AgeRecognition final : public RecognitionOfPeople {
public:
    using RecognitionOfPeople::RecognitionOfPeople;

private:
    static constexpr double sigma = 3;  // years
    static constexpr int margin = 6;    // years to either side of the estimate

    bool can_report(Person const& person) const override { return person.age.has_value(); }

    // The estimated age. It is the same during one visit.
    int estimate(Person const& person) const {
        Random random{mixed({hall().seed(), 7, static_cast<std::uint64_t>(robot()), static_cast<std::uint64_t>(person.id)})};
        return static_cast<int>(std::lround(*person.age + random.gaussian() * sigma));
    }

    void report(std::vector<Person const*> const& people, Results results) override {
        results.parameters.push_back(
            numbers("lower_age_limit", people, [&](Person const& person) { return std::max(0, estimate(person) - margin); }));
        results.parameters.push_back(
            numbers("upper_age_limit", people, [&](Person const& person) { return std::max(0, estimate(person) + margin); }));
        port().event("person_age_recognized", std::move(results));
    }
};

}  // namespace

std::unique_ptr<Component> person_gender_identification(Context context) {
    return std::make_unique<GenderIdentification>(std::move(context));
}

std::unique_ptr<Component> person_age_recognition(Context context) {
    return std::make_unique<AgeRecognition>(std::move(context));
}

}  // namespace rois::simulation
