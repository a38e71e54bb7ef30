#include "choosing/common_profile.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "types/text/texts.hpp"

namespace rois::choosing {

namespace {

std::string_view name_of(MessageKind kind) {
    switch (kind) {
        case MessageKind::command:
            return "command";
        case MessageKind::query:
            return "query";
        case MessageKind::event:
            break;
    }
    return "event";
}

bool has(std::vector<ParameterProfile> const& list, ParameterProfile const& wanted) {
    auto const* found = find_parameter(list, wanted.name);
    return found != nullptr && found->data_type_ref.code == wanted.data_type_ref.code;
}

bool have_same_names(std::vector<ParameterProfile> const& a, std::vector<ParameterProfile> const& b) {
    return a.size() == b.size() && std::ranges::all_of(a, [&](auto const& each) { return has(b, each); });
}

// Removes from `list` what `other` lacks. `note` is called with each name.
template <class Note>
void keep_common(std::vector<ParameterProfile>& list, std::vector<ParameterProfile> const& other, Note const& note) {
    std::erase_if(list, [&](ParameterProfile const& each) {
        if (has(other, each)) return false;
        note(each.name);
        return true;
    });
}

// A result that another member does not have would not fit the common profile, so such a message is left out. Of `get_parameter`
// only such results are left out.
template <class Note>
void keep_common(ComponentProfile& profile, ComponentProfile const& other, Note const& note) {
    std::erase_if(profile.messages, [&](MessageProfile& message) {
        auto const* theirs = find_message(other, message.kind, message.name);
        auto const shown = std::string{name_of(message.kind)} + " " + quoted(message.name);
        bool const reads = message.kind == MessageKind::query && message.name == "get_parameter";
        if (theirs == nullptr || (!reads && !have_same_names(message.results, theirs->results))) {
            note(shown);
            return true;
        }
        keep_common(message.results, theirs->results, [&](std::string const& name) {
            if (find_parameter(profile.parameters, name) == nullptr) note("parameter " + quoted(name));
        });
        keep_common(message.arguments, theirs->arguments,
                    [&](std::string const& name) { note("argument " + quoted(name) + " of the " + shown); });
        if (message.timeout && theirs->timeout) message.timeout = std::max(*message.timeout, *theirs->timeout);
        return false;
    });
    keep_common(profile.parameters, other.parameters, [&](std::string const& name) { note("parameter " + quoted(name)); });
}

// The positions of a logical component are in the engine's own frame, and not in that of its first member.
void leave_out_frames(ComponentProfile& profile, ComponentDescription const& member) {
    auto const leave_out = [&](std::vector<ParameterProfile>& list) {
        for (auto& each : list) {
            auto& codebook = each.data_type_ref.codebook_ref;
            if (codebook == member.crs || std::ranges::find(member.positions, each.name) != member.positions.end())
                codebook.clear();
        }
    };
    leave_out(profile.parameters);
    for (auto& message : profile.messages) {
        leave_out(message.arguments);
        leave_out(message.results);
    }
}

}  // namespace

bool is_within(ComponentProfile const& small, ComponentProfile const& large) {
    auto kept = small;
    keep_common(kept, large, [](auto const&) {});
    return kept == small;
}

Common common(std::string const& ref, std::vector<ComponentDescription const*> const& members) {
    auto const& first = *members.front();
    Common common;
    auto& description = common.description;
    description.ref = first.ref;
    description.ref.code = ref;
    auto profile = *first.profile;
    for (auto const* member : members) {
        keep_common(profile, *member->profile, [&](std::string const& what) {
            common.left_out.push_back("the " + what + ", which " + member->ref.code + " lacks");
        });
        description.moves = description.moves || member->moves;
        for (auto const& position : member->positions)
            if (std::ranges::find(description.positions, position) == description.positions.end())
                description.positions.push_back(position);
    }
    leave_out_frames(profile, first);
    description.codebooks = first.codebooks;
    description.alternatives = first.alternatives;
    description.status_when_stopped = first.status_when_stopped;
    description.profile = std::make_shared<ComponentProfile const>(std::move(profile));
    return common;
}

}  // namespace rois::choosing
