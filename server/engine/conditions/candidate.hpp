// The objects that a condition is matched against: a component, an event of a component, or results.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/conditions/vocabulary.hpp"
#include "types/values.hpp"

namespace rois {

// How well a candidate meets a condition. `maybe`: the value that decides is not known yet, or may change.
enum class Match : std::uint8_t { no, maybe, yes };

using Texts = std::vector<std::string>;
using Positions = std::vector<Geometry>;

class Candidate;

// Which session has bound a component, as seen by the session that asks. Ordered from the easiest to bind to the hardest.
enum class Holder : std::uint8_t { asker, nobody, another_session };

// The verdict of a group condition about one robot.
struct GroupVerdict {
    Match match = Match::no;
    // How the asker gets the group's components from this robot. Set if the robot matches.
    std::size_t bound = 0;                  // components that the asker has bound
    std::vector<Candidate const*> to_bind;  // free components that the asker lacks
    Candidate const* held =
        nullptr;  // a component that the asker lacks and that only other sessions have bound; null if there is none
};

class Candidate {
public:
    virtual ~Candidate() = default;

    // Returns the values of a reference; empty if it has no value, nullopt if the value is not known yet.
    virtual std::optional<Texts> texts(Reference const&) const = 0;
    virtual std::optional<Positions> positions(Reference const&) const = 0;

    // Returns whether the candidate has this property, with or without a value.
    virtual bool has(Reference const&) const = 0;

    // The name that ResourceId refers to; empty if the candidate has no name.
    virtual std::string_view rid() const = 0;

    // All components of the candidate's robot (its engine); empty if it belongs to none.
    virtual std::vector<Candidate const*> robot() const = 0;

    // Where the verdict of a group condition about the candidate's robot is cached. Null if it belongs to no robot.
    virtual std::optional<GroupVerdict>* verdict(void const* group) const = 0;

    // Only components can be bound.
    virtual Holder holder() const { return Holder::nobody; }
};

// A component, together with the results of one of its events or of its answer to a query. Keeps references to both.
class MessageCandidate final : public Candidate {
public:
    MessageCandidate(Candidate const& component, Results const& results) : component_{component}, results_{results} {}

    std::optional<Texts> texts(Reference const&) const override;
    std::optional<Positions> positions(Reference const&) const override;
    bool has(Reference const&) const override;
    std::string_view rid() const override { return component_.rid(); }
    std::vector<Candidate const*> robot() const override { return component_.robot(); }
    std::optional<GroupVerdict>* verdict(void const* group) const override { return component_.verdict(group); }
    Holder holder() const override { return component_.holder(); }

private:
    Candidate const& component_;
    Results const& results_;
};

// Results without a component. `id` is the id that the application asked with.
class ResultsCandidate final : public Candidate {
public:
    ResultsCandidate(Results const& results, std::string_view id) : results_{results}, id_{id} {}

    std::optional<Texts> texts(Reference const&) const override;
    std::optional<Positions> positions(Reference const&) const override;
    bool has(Reference const&) const override;
    std::string_view rid() const override { return id_; }
    std::vector<Candidate const*> robot() const override { return {}; }
    std::optional<GroupVerdict>* verdict(void const*) const override { return nullptr; }

private:
    Results const& results_;
    std::string_view id_;
};

}  // namespace rois
