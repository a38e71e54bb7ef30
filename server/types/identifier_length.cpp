#include "types/identifier_length.hpp"

#include <algorithm>
#include <functional>

#include "types/text/text_encoding.hpp"
#include "types/text/texts.hpp"

namespace rois {

std::optional<std::string> why_too_long(std::string_view what, std::string_view text) {
    if (text.size() <= longest_identifier) return {};
    auto const characters = static_cast<std::size_t>(std::ranges::count_if(text, std::not_fn(continues_character)));
    if (characters <= longest_identifier) return {};
    return std::string{what} + " " + quoted(text) + " has " + std::to_string(characters) + " characters: expected " +
           std::to_string(longest_identifier) + " at most";
}

namespace {

using Problem = std::optional<std::string>;

Problem first_of(std::initializer_list<std::pair<std::string_view, std::string_view>> texts) {
    for (auto const& [what, text] : texts)
        if (auto problem = why_too_long(what, text)) return problem;
    return {};
}

Problem problem_of(Identifier const& ref) {
    return first_of({{"component_ref", ref.code},
                     {"the authority of a component_ref", ref.authority},
                     {"the codebook_ref of a component_ref", ref.codebook_ref},
                     {"the version of a component_ref", ref.version}});
}

Problem problem_of(ParameterList const& parameters) {
    for (auto const& [name, type, values] : parameters)
        if (auto problem = first_of({{"the name of a parameter", name},
                                     {"the data_type_ref of a parameter", type.code},
                                     {"the authority of a data_type_ref", type.authority},
                                     {"the codebook_ref of a data_type_ref", type.codebook_ref},
                                     {"the version of a data_type_ref", type.version}}))
            return problem;
    return {};
}

struct Checker {
    Problem operator()(DelayOnly const&) const { return {}; }
    Problem operator()(CommandMessage const& message) const {
        if (auto problem = first_of({{"command_type", message.command_type}, {"command_id", message.command_id.text}}))
            return problem;
        auto problem = problem_of(message.component_ref);
        return problem ? problem : problem_of(message.arguments);
    }
    Problem operator()(ConcurrentCommands const& concurrent) const {
        for (auto const& branch : concurrent.branches)
            if (auto problem = in(branch.command_list)) return problem;
        return {};
    }
    Problem operator()(SequentialCommandUnit const& unit) const { return in(unit.command_unit_list); }
    Problem operator()(ParallelCommandUnit const& unit) const { return in(unit.command_unit_list); }

    Problem in(std::vector<CommandUnit> const& units) const {
        for (auto const& unit : units)
            if (auto problem = std::visit(*this, unit.unit)) return problem;
        return {};
    }

    Problem operator()(Connect const&) const { return {}; }
    Problem operator()(Resume const&) const { return {}; }
    Problem operator()(Disconnect const&) const { return {}; }
    Problem operator()(GetProfile const&) const { return {}; }
    Problem operator()(GetErrorDetail const& get) const { return why_too_long("error_id", get.error_id.text); }
    Problem operator()(Search const&) const { return {}; }
    Problem operator()(Bind const& bind) const { return problem_of(bind.component_ref); }
    Problem operator()(BindAny const&) const { return {}; }
    Problem operator()(Release const& release) const { return problem_of(release.component_ref); }
    Problem operator()(GetParameter const& get) const { return problem_of(get.component_ref); }
    Problem operator()(SetParameter const& set) const {
        auto problem = problem_of(set.component_ref);
        return problem ? problem : problem_of(set.parameters);
    }
    Problem operator()(Execute const& execute) const { return in(execute.command_unit_list.command_unit_list); }
    Problem operator()(GetCommandResult const& get) const { return why_too_long("command_id", get.command_id.text); }
    Problem operator()(Query const& query) const { return why_too_long("query_type", query.query_type); }
    Problem operator()(Subscribe const& subscribe) const { return why_too_long("event_type", subscribe.event_type); }
    Problem operator()(Unsubscribe const& unsubscribe) const {
        return why_too_long("subscribe_id", unsubscribe.subscribe_id.text);
    }
    Problem operator()(GetEventDetail const& get) const { return why_too_long("event_id", get.event_id.text); }
    Problem operator()(StopEverything const&) const { return {}; }
    Problem operator()(ClearStop const&) const { return {}; }
};

}  // namespace

Problem why_too_long(Operation const& operation) { return std::visit(Checker{}, operation); }

}  // namespace rois
