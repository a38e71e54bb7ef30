// Parameters of bound components (7.4.2, figure 9; tables 16, 19; decisions 8 and 26).
#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "conformance/context.hpp"

namespace rois::conformance {

namespace {

std::string upper(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return text;
}

// An integer parameter of a component that the client has bound.
class BoundNumber {
public:
    explicit BoundNumber(Context& context) : number{number_parameter_of(context)}, client{context} {
        client.bind_or_skip(*number.component);
    }

    std::string value() {
        auto const values = require_ok(client.get_parameter(number.component->ref)).values("parameters");
        auto const found = values.find(number.name);
        return found == values.end() || found->second.empty() ? "" : found->second.front();
    }
    std::string text(int value) const { return number.text(value); }
    Document set(std::vector<Argument> const& arguments) { return client.set_parameter(number.component->ref, arguments); }

    NumberParameter number;
    Client client;
};

void set_parameter_completes_once_and_stores_the_value(Context& context) {
    BoundNumber bound{context};
    auto const id = require_ok(bound.set({with_value(bound.number, 41)})).text("command_id");
    require(!id.empty(), "set_parameter: expected a command_id in the answer, got none");
    require_equal("the status of set_parameter", "OK", bound.client.status_of(id));
    require_equal(bound.number.name, bound.text(41), bound.value());
    require_ok(bound.set({with_value(bound.number, 42)}));
    bound.client.flush_notifications(*bound.number.component);
    require_equal(bound.number.name, bound.text(42), bound.value());
    require(bound.client.completion_statuses(id).size() == 1,
            "expected set_parameter to complete once, got " + list(bound.client.completion_statuses(id)));
}

void set_parameter_as_a_command_stores_the_value(Context& context) {
    BoundNumber bound{context};
    require_equal(
        "the status", "OK",
        bound.client.run(
            {.component = bound.number.component->ref, .type = "set_parameter", .arguments = {with_value(bound.number, 43)}}));
    require_equal(bound.number.name, bound.text(43), bound.value());
}

void parameter_names_are_case_insensitive(Context& context) {
    BoundNumber bound{context};
    require_ok(bound.set({{upper(bound.number.name), upper(bound.number.type), {bound.text(44)}}}));
    require_equal(bound.number.name, bound.text(44), bound.value());
}

void data_types_may_be_urns(Context& context) {
    BoundNumber bound{context};
    require_ok(bound.set({{bound.number.name, "urn:x-rois:def:DataType:ATR::Integer", {bound.text(49)}}}));
    require_equal(bound.number.name, bound.text(49), bound.value());
}

// Names of parameters in the published profiles that differ from the names in the specification.
void published_spellings_are_accepted(Context& context) {
    struct Spelling {
        char const *kind, *specified, *published, *type;
    };
    static constexpr std::array<Spelling, 3> spellings{{{"navigation", "target_position", "target_positions", "string[]"},
                                                        {"speechsynthesis", "SSML_text", "ssml_text", "string"},
                                                        {"speechrecognition", "grammar", "grammer", "string"}}};
    bool ran = false;
    for (auto const& [kind, specified, published, type] : spellings)
        for (auto const& component : context.catalogue().components) {
            if (component.basic() != kind) continue;
            Client client{context};
            if (client.bind(component.ref).return_code() != "OK") continue;
            auto const values = client.get_parameter(component.ref).values("parameters");
            auto const found = values.find(specified);
            if (found == values.end() || found->second.empty()) continue;  // a valid value is unknown
            require_ok(client.set_parameter(component.ref, {{published, type, found->second}}));
            ran = true;
        }
    if (!ran) throw Skipped{"no free component has a value for a parameter with two spellings"};
}

// The codes of ISO 639-1, without the withdrawn ones (bh, mo, sh).
constexpr std::string_view languages =
    "aa ab ae af ak am an ar as av ay az ba be bg bi bm bn bo br bs ca ce ch co cr cs cu cv cy da de dv dz ee el en eo es et eu "
    "fa "
    "ff fi fj fo fr fy ga gd gl gn gu gv ha he hi ho hr ht hu hy hz ia id ie ig ii ik io is it iu ja jv ka kg ki kj kk kl km kn "
    "ko "
    "kr ks ku kv kw ky la lb lg li ln lo lt lu lv mg mh mi mk ml mn mr ms mt my na nb nd ne ng nl nn no nr nv ny oc oj om or os "
    "pa "
    "pi pl ps pt qu rm rn ro ru rw sa sc sd se sg si sk sl sm sn so sq sr ss st su sv sw ta te tg th ti tk tl tn to tr ts tt tw "
    "ty "
    "ug uk ur uz ve vi vo wa wo xh yi yo za zh zu ";

bool is_language(std::string const& code) { return code.size() == 2 && languages.find(code + " ") != languages.npos; }

void languages_are_iso_639_1_codes(Context& context) {
    bool ran = false;
    Client client{context};
    for (auto const* const kind : {"speechrecognition", "speechsynthesis"})
        for (auto const& component : context.catalogue().components) {
            if (component.basic() != kind || !component.query("get_parameter")) continue;
            for (auto const& [name, values] : client.query("get_parameter", only(component)).values())
                for (auto const& text : values) {
                    if (name != "language" && !name.ends_with("languages")) continue;
                    require(is_language(text),
                            name + " of " + component.ref + ": '" + text + "' is not a language code: expected ISO 639-1");
                    ran = true;
                }
        }
    if (!ran) throw Skipped{"no component reports languages"};
}

void invalid_parameters_are_refused(Context& context) {
    BoundNumber bound{context};
    auto const& [component, name, type, base] = bound.number;
    require_ok(bound.set({with_value(bound.number, 45)}));
    require_refusal(bound.set({{unknown_name, "string", {"red"}}}), "BAD_PARAMETER", unknown_name);
    require_refusal(bound.set({{name, type, {"soon"}}}), "BAD_PARAMETER", name);
    require_refusal(bound.set({{name, type, {bound.text(46), bound.text(47)}}}), "BAD_PARAMETER", name);
    require_refusal(bound.set({{name, "string", {bound.text(46)}}}), "BAD_PARAMETER", name);
    require_refusal(bound.set({{name, type, {"99999999999"}}}), "BAD_PARAMETER", name);
    require_refusal(bound.set({with_value(bound.number, 46), {unknown_name, "string", {"red"}}}), "BAD_PARAMETER", unknown_name);
    require_equal(name + " after a refused value", bound.text(45), bound.value());
}

// Compares the names and types of the parameters of all free components with their profiles.
void parameters_match_the_profile(Context& context) {
    Client client{context};
    for (auto const& component : context.catalogue().components) {
        if (client.bind(component.ref).return_code() != "OK") continue;
        auto const answer = client.get_parameter(component.ref);
        if (answer.return_code() == "ERROR") continue;  // a component that has failed
        auto known = component.parameters;
        if (auto const* const query = component.query("get_parameter"))
            known.insert(known.end(), query->results.begin(), query->results.end());
        for (auto const& [name, values] : require_ok(answer).values("parameters")) {
            auto const found = std::ranges::find(known, name, &TypedName::name);
            require(found != known.end(), "the profile of " + component.ref + " lacks the parameter " + name);
            require(is_of_type(found->type, values),
                    name + " of " + component.ref + ": expected a value of type " + found->type + ", got " + list(values));
        }
    }
}

void the_query_get_parameter_hides_set_values(Context& context) {
    BoundNumber bound{context};
    require_ok(bound.set({with_value(bound.number, 48)}));
    if (!bound.number.component->query("get_parameter"))
        throw Skipped{bound.number.component->ref + " has no query get_parameter"};
    Client other{context};
    auto const values = require_ok(other.query("get_parameter", only(*bound.number.component))).values();
    auto const found = values.find(bound.number.name);
    require(found == values.end() || found->second != std::vector{bound.text(48)},
            "the query get_parameter returned the value of another application: " + bound.number.name + " = " + bound.text(48));
}

void release_discards_set_parameters(Context& context) {
    BoundNumber bound{context};
    auto const& ref = bound.number.component->ref;
    require_ok(bound.set({with_value(bound.number, 47)}));
    require_equal(bound.number.name, bound.text(47), bound.value());
    require_ok(bound.client.release(ref));
    auto const answer = bound.client.bind(ref);
    if (answer.return_code() == "OUT_OF_RESOURCES") throw Skipped{"another application uses " + ref};
    require_ok(answer);
    require(bound.value() != bound.text(47),
            bound.number.name + " of " + ref + " still has the value from before release: " + bound.text(47));
}

// Sets the code of a known reaction, with and without an unknown codebook. Starts no reaction.
void identifiers_of_an_unknown_codebook_are_refused(Context& context) {
    auto const& reaction = context.component_of_kind({"reaction"});
    Client client{context};
    client.bind_or_skip(reaction);
    auto const answer = require_ok(client.get_parameter(reaction.ref));
    auto const parameters = answer.values("parameters");
    auto const reactions = parameters.find("available_reactions");
    if (reactions == parameters.end() || reactions->second.empty()) throw Skipped{reaction.ref + " has no available_reactions"};
    auto const expected = argument(reaction, "reaction_ref", {reactions->second.front()});
    auto const set = [&](kit::Attributes type_ref) {
        type_ref.insert(type_ref.begin(), {"rois:code", expected.type});
        auto const content =
            kit::element("rois:data_type_ref", type_ref) + kit::text_element("rois:value", expected.values.front());
        auto const parameter = kit::element("parameter", {{"rois:name", expected.name}}, content);
        return client.ask("set_parameter", kit::component_ref(reaction.ref) + kit::element("parameters", parameter));
    };
    require_ok(set({}));
    auto const reported = answer.root().child("parameters").find_child_by_attribute("rois:name", "available_reactions");
    std::string const known = reported.child("rois:data_type_ref").attribute("rois:codebook_ref").value();
    require_refusal(set({{"rois:codebook_ref", "urn:x-conformance:codebook:nowhere"}}), "BAD_PARAMETER", known);
}

}  // namespace

Clause parameter_clause() {
    return {"7.4.2 Command interface: parameters",
            {{"set_parameter_completes_once_and_stores_the_value", "figure 9; table 3; decisions 8, 12",
              set_parameter_completes_once_and_stores_the_value},
             {"set_parameter_as_a_command_stores_the_value", "table 12", set_parameter_as_a_command_stores_the_value},
             {"parameter_names_are_case_insensitive", "decision 26", parameter_names_are_case_insensitive},
             {"data_types_may_be_urns", "table 16; decision 26", data_types_may_be_urns},
             {"published_spellings_are_accepted", "decision 26", published_spellings_are_accepted},
             {"languages_are_iso_639_1_codes", "tables 42, 44; decision 28", languages_are_iso_639_1_codes},
             {"invalid_parameters_are_refused", "table 1; decision 26", invalid_parameters_are_refused},
             {"parameters_match_the_profile", "figure 9; tables 16, 19; decision 26", parameters_match_the_profile},
             {"the_query_get_parameter_hides_set_values", "decision 18", the_query_get_parameter_hides_set_values},
             {"release_discards_set_parameters", "figure 11; decision 30", release_discards_set_parameters},
             {"identifiers_of_an_unknown_codebook_are_refused", "table 45; decision 31",
              identifiers_of_an_unknown_codebook_are_refused}}};
}

}  // namespace rois::conformance
