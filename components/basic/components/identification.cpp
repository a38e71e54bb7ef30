// Person identification (7.6.4): reports the id of a known visitor, once while they are tracked.
#include "basic/base/codebooks.hpp"
#include "basic/base/person_recognition.hpp"
#include "basic/components/basic_components.hpp"

namespace rois::basic {
namespace {

class Identification final : public PersonRecognition {
public:
    explicit Identification(Context context) : PersonRecognition{std::move(context), "person_identified", codebook::visitor} {}

private:
    std::optional<std::string> name_of(RecognizedPerson const& person) const override { return person.id; }
};

}  // namespace

std::unique_ptr<LocalComponent> person_identification(Context context) {
    return std::make_unique<Identification>(std::move(context));
}

}  // namespace rois::basic
