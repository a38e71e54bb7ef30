// Person gender identification and person age recognition (Annex C.2, C.3): report people who are near enough and turned to the
// robot, once while they are tracked.
#include <utility>

#include "basic/adapters/example_components.hpp"
#include "basic/base/codebooks.hpp"
#include "basic/base/person_recognition.hpp"

namespace rois::basic {
namespace {

// Writes a list of numbers.
template <class NumberOf>
Parameter numbers(std::string name, std::vector<RecognizedPerson> const& people, NumberOf number_of) {
    std::string text;
    for (auto const& person : people) text += (text.empty() ? "" : " ") + std::to_string(number_of(person));
    return {.name = std::move(name),
            .data_type_ref = {.code = "int[]", .authority = {}, .codebook_ref = {}, .version = {}},
            .values = {std::move(text)}};
}

class GenderIdentification final : public PersonRecognition {
public:
    explicit GenderIdentification(Context context)
        : PersonRecognition{std::move(context), "person_gender_identified", codebook::track} {}

private:
    std::optional<std::string> name_of(RecognizedPerson const& person) const override { return person.track; }

    void describe(std::vector<RecognizedPerson> const& people, ParameterList& results) const override {
        results.push_back(
            numbers("person_gender_code", people, [](auto const& person) { return static_cast<int>(person.gender); }));
        results.back().data_type_ref.codebook_ref = codebook::gender;
    }
};

class AgeRecognition final : public PersonRecognition {
public:
    explicit AgeRecognition(Context context) : PersonRecognition{std::move(context), "person_age_recognized", codebook::track} {}

private:
    std::optional<std::string> name_of(RecognizedPerson const& person) const override {
        return person.age ? std::optional{person.track} : std::nullopt;
    }

    void describe(std::vector<RecognizedPerson> const& people, ParameterList& results) const override {
        results.push_back(numbers("lower_age_limit", people, [](auto const& person) { return person.age->lowest; }));
        results.push_back(numbers("upper_age_limit", people, [](auto const& person) { return person.age->highest; }));
    }
};

}  // namespace

std::unique_ptr<LocalComponent> person_gender_identification(Context context) {
    return std::make_unique<GenderIdentification>(std::move(context));
}

std::unique_ptr<LocalComponent> person_age_recognition(Context context) {
    return std::make_unique<AgeRecognition>(std::move(context));
}

}  // namespace rois::basic
