// Reaction (7.6.12): shows a reaction of Annex D.
#include <utility>

#include "basic/base/codebooks.hpp"
#include "basic/base/parameter_reading.hpp"
#include "basic/components/basic_components.hpp"
#include "basic/components/reaction_types.hpp"
#include "types/text/texts.hpp"

namespace rois::basic {
namespace {

class Reaction final : public Action {
public:
    explicit Reaction(Context context)
        : Action{with_identifier_parameter(with_motion(std::move(context)), "reaction_ref", {codebook::reaction})} {}

    ParameterList readable_parameters() const override {
        std::vector<std::string> codes;
        for (std::size_t i = 1; i <= reaction_types.size(); ++i) codes.push_back(std::to_string(i));
        return {references("available_reactions", std::move(codes), std::string{codebook::reaction})};
    }

private:
    std::optional<std::string> parameter_problem(ParameterList const& parameters) const override {
        auto const wanted = text_of(parameters, "reaction_ref");
        if (wanted.empty() || !reaction_code(wanted).empty()) return {};
        return "parameter 'reaction_ref': " + quoted(wanted) + " is unknown; expected 1 to " +
               std::to_string(reaction_types.size()) + " of " + std::string{codebook::reaction} +
               " or a name such as nod (1), bow (9) or wave (28)";
    }

    std::variant<Plan, Refused> plan(ParameterList const& parameters) override {
        auto const wanted = text_of(parameters, "reaction_ref");
        if (wanted.empty()) return Refused{"parameter 'reaction_ref' is mandatory"};
        return [this, code = std::string{reaction_code(wanted)}] {
            code_ = code;
            go_on();
        };
    }

    Seconds remaining() const { return reaction_type(code_).duration - in_seconds(elapsed()); }

    void act() override {
        if (remaining() <= 0) end(CompletedStatus::ok);
    }

    void stop() override { body().stop_showing(); }
    void hold() override { body().stop_showing(); }
    void go_on() override { body().show(code_, remaining()); }

    std::string code_;
};

}  // namespace

std::unique_ptr<LocalComponent> reaction(Context context) { return std::make_unique<Reaction>(std::move(context)); }

}  // namespace rois::basic
