#include "xml/profiles/profile_decoder.hpp"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "types/data_type.hpp"
#include "types/text/texts.hpp"
#include "xml/codec/decoding.hpp"
#include "xml/codec/place.hpp"
#include "xml/codec/tree.hpp"

namespace rois::xml {

namespace {

std::string text_of_child(pugi::xml_node element, std::string_view name) {
    return std::string{trimmed(text_of(child(element, name)))};
}

Identifier identifier(pugi::xml_node node) {
    return {attribute_text(node, "code"), attribute_text(node, "authority"), attribute_text(node, "codebook_ref"),
            attribute_text(node, "version")};
}

// Decodes a profile from a valid tree, and collects warnings.
class ProfileDecoder {
public:
    ProfileDecoder(std::string const& name, Places& places) : name_{name}, places_{places} {}

    ProfileDocument decode(pugi::xml_node root) {
        if (local_name(root) == "HRIEngineProfile") {
            document_.profile = engine(root);
        } else if (local_name(root) == "HRIComponentProfile") {
            document_.profile = component(root);
        } else {
            throw complain(root, "the root element is " + quoted(local_name(root)) +
                                     ": expected 'HRIComponentProfile' or 'HRIEngineProfile'");
        }
        return std::move(document_);
    }

private:
    std::string place(pugi::xml_node element) { return at(name_, places_.of(offset_of(element))); }

    // Returns an empty text if there is no such child.
    std::string place_of_child(pugi::xml_node element, std::string_view name) {
        auto const found = child(element, name);
        return found ? place(found) : std::string{};
    }

    BadDocument complain(pugi::xml_node element, std::string const& reason) {
        return BadDocument{place(element) + ": " + reason};
    }

    static IdentifiedObject object(pugi::xml_node root) {
        auto const meta_data = child(root, "metaDataProperty");
        return {.identifier = text_of_child(root, "identifier"),
                .code_space = attribute_text(child(root, "identifier"), "codeSpace"),
                .name = text_of_child(root, "name"),
                .description = text_of_child(root, "description"),
                .meta_data = std::string{trimmed(attribute_text(meta_data, "href"))}};
    }

    ComponentProfile component(pugi::xml_node root) {
        ComponentProfile profile{object(root), {}, {}, parameters(root, "ParameterProfile")};
        if (profile.object.identifier.empty()) throw complain(root, "the identifier is empty: expected a URN");
        document_.adapter_place = place_of_child(root, "metaDataProperty");
        document_.identifier_place = place_of_child(root, "identifier");
        document_.name_place = place_of_child(root, "name");
        for (auto const element : root.children()) {
            if (local_name(element) == "SubComponentProfile") {
                profile.sub_components.emplace_back(trimmed(text_of(element)));
                document_.sub_component_places.push_back(place(element));
            } else if (local_name(element) == "MessageProfile") {
                auto read = message(element);
                if (find_message(profile, read.kind, read.name) != nullptr)
                    throw complain(element, "duplicate message " + quoted(read.name) + " of this kind");
                if (auto const problem = why_reserved(read)) throw complain(element, *problem);
                profile.messages.push_back(std::move(read));
            }
        }
        reject_contradictions(root, profile);
        return profile;
    }

    // Returns why the message conflicts with a result or query that the engine answers itself, or nothing.
    static std::optional<std::string> why_reserved(MessageProfile const& message) {
        auto const is_status = [](ParameterProfile const& result) { return equal_ignoring_case(result.name, "status"); };
        if (message.kind == MessageKind::command && std::ranges::any_of(message.results, is_status))
            return "the command " + quoted(message.name) +
                   " has a result 'status': rename it, because get_command_result adds a result of this name";
        if (message.kind != MessageKind::query || message.name != "component_status") return {};
        bool const standard = message.results.size() == 1 && message.results.front().name == "status" &&
                              DataType::of(message.results.front().data_type_ref).base == BaseType::component_status;
        if (standard) return {};
        return "the engine answers the query 'component_status': expected one result, 'status' of the type Component_Status";
    }

    // A parameter that a document defines in several places must have the same type and default value in all of them.
    void reject_contradictions(pugi::xml_node root, ComponentProfile const& profile) {
        auto const* const set = find_message(profile, MessageKind::command, "set_parameter");
        auto const* const get = find_message(profile, MessageKind::query, "get_parameter");
        if (set != nullptr) compare(root, "ParameterProfile", profile.parameters, set->arguments);
        if (get == nullptr) return;
        compare(root, "ParameterProfile", profile.parameters, get->results);
        if (set == nullptr) return;
        for (auto const element : root.children())
            if (local_name(element) == "MessageProfile" && trimmed(attribute_text(element, "name")) == "get_parameter")
                compare(element, "Results", get->results, set->arguments);
    }

    // `list` was decoded from the children of `parent` with this name. Throws BadDocument if `others` contradict it.
    void compare(pugi::xml_node parent, std::string_view name, std::vector<ParameterProfile> const& list,
                 std::vector<ParameterProfile> const& others) {
        auto each = list.begin();
        for (auto const element : parent.children()) {
            if (local_name(element) != name || each == list.end()) continue;
            auto const* const other = find_parameter(others, each->name);
            if (other != nullptr && contradict(*each, *other))
                throw complain(element, quoted(each->name) + " is defined twice, with different types or default values");
            ++each;
        }
    }

    static bool contradict(ParameterProfile const& one, ParameterProfile const& other) {
        if (!(DataType::of(one.data_type_ref) == DataType::of(other.data_type_ref))) return true;
        return one.default_value && other.default_value && *one.default_value != *other.default_value;
    }

    EngineProfile engine(pugi::xml_node root) {
        EngineProfile profile{object(root), {}, {}, parameters(root, "ParameterProfile")};
        for (auto const element : root.children()) {
            if (local_name(element) == "SubProfile") profile.sub_profiles.push_back(engine(element));
            if (local_name(element) != "HRIComponent") continue;
            auto const text = text_of(element);
            if (auto const component = trimmed(text); !component.empty()) profile.components.emplace_back(component);
        }
        return profile;
    }

    std::vector<ParameterProfile> parameters(pugi::xml_node parent, std::string_view name) {
        std::vector<ParameterProfile> list;
        std::set<std::string> names;
        for (auto const element : parent.children()) {
            if (local_name(element) != name) continue;
            auto read = parameter(element);
            if (!names.insert(read.name).second) throw complain(element, "duplicate name " + quoted(read.name));
            list.push_back(std::move(read));
        }
        return list;
    }

    ParameterProfile parameter(pugi::xml_node element) {
        ParameterProfile read{.name = std::string{trimmed(attribute_text(element, "name"))},
                              .data_type_ref = identifier(child(element, "data_type_ref")),
                              .default_value = {},
                              .description = attribute_text(element, "description")};
        if (read.name.empty()) throw complain(element, "the name is empty");
        if (trimmed(read.data_type_ref.code).empty())
            throw complain(element, "the data type of " + quoted(read.name) + " is empty");
        if (!is_known(DataType::of(read.data_type_ref)))
            document_.warnings.push_back(place(child(element, "data_type_ref")) + ": unknown data type " +
                                         quoted(trimmed(read.data_type_ref.code)) + " of " + quoted(read.name) +
                                         ": its values are not checked");
        if (auto const written = attribute(element, "default_value")) set_default(element, read, written.value());
        return read;
    }

    // Converts times to UTC (decision 28).
    static std::string in_reported_form(Identifier const& data_type_ref, std::string text) {
        if (DataType::of(data_type_ref).base != BaseType::date_time) return text;
        std::string reported;
        for (auto const& value : default_values(data_type_ref, text)) reported += (reported.empty() ? "" : " ") + value;
        return reported;
    }

    // In published profiles, an empty default value means that there is none.
    void set_default(pugi::xml_node element, ParameterProfile& parameter, std::string text) {
        auto const problem = why_not(DataType::of(parameter.data_type_ref), default_values(parameter.data_type_ref, text));
        if (!problem) {
            parameter.default_value = in_reported_form(parameter.data_type_ref, std::move(text));
        } else if (trimmed(text).empty()) {
            document_.warnings.push_back(place(element) + ": the default value of " + quoted(parameter.name) +
                                         " is empty: ignored");
        } else {
            throw complain(element, "the default value of " + quoted(parameter.name) + ": " + *problem);
        }
    }

    MessageProfile message(pugi::xml_node element) {
        MessageProfile read{.kind = kind_of(element),
                            .name = std::string{trimmed(attribute_text(element, "name"))},
                            .results = parameters(element, "Results"),
                            .arguments = parameters(element, "Arguments"),
                            .timeout = timeout(element)};
        if (read.name.empty()) throw complain(element, "the name of a message is empty");
        return read;
    }

    MessageKind kind_of(pugi::xml_node message) {
        auto const type = xsi_type(message);
        auto const name = type ? type->local_name : std::string_view{};
        if (name == "CommandMessageProfileType") return MessageKind::command;
        if (name == "QueryMessageProfileType") return MessageKind::query;
        if (name == "EventMessageProfileType") return MessageKind::event;
        throw complain(message,
                       "a message needs an xsi:type: expected one of CommandMessageProfileType, QueryMessageProfileType, "
                       "EventMessageProfileType");
    }

    // A timeout is the number of milliseconds within which a command must have started (decision 16).
    std::optional<std::chrono::milliseconds> timeout(pugi::xml_node message) {
        auto const written = attribute(message, "timeout");
        if (!written) return std::nullopt;
        auto const milliseconds = decode_integer(written.value());
        constexpr std::int64_t longest = 1'000LL * 60 * 60 * 24 * 365;
        if (milliseconds < 0 || milliseconds > longest)
            throw complain(message, "the timeout is " + quoted(written.value()) + ": expected milliseconds from 0 to " +
                                        std::to_string(longest));
        return std::chrono::milliseconds{milliseconds};
    }

    std::string const& name_;
    Places& places_;
    ProfileDocument document_;
};

}  // namespace

std::string at(std::string const& name, Place place) {
    return name + ":" + std::to_string(place.line) + ":" + std::to_string(place.column);
}

ProfileDocument decode_profile(pugi::xml_node root, std::string const& name, Places& places) {
    return ProfileDecoder{name, places}.decode(root);
}

}  // namespace rois::xml
