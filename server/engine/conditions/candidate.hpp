// Candidates: the objects that a condition is matched against. A candidate is a component, an event of a component, or a list of
// results.
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

// The result of matching a candidate against a condition. `maybe`: the deciding value is not known yet, or may change.
enum class Match : std::uint8_t { no, maybe, yes };

using Texts = std::vector<std::string>;
using Positions = std::vector<Geometry>;

class Candidate;

// The session that has bound a component, seen from the session that asks (the asker). Ordered from the easiest to bind to the
// hardest.
enum class Holder : std::uint8_t { asker, nobody, another_session };

// The result of a group condition for one robot.
struct GroupVerdict {
    Match match = Match::no;
    // The group's components of this robot, by holder. Set if the robot matches.
    std::size_t bound = 0;                  // components that the asker has bound
    std::vector<Candidate const*> to_bind;  // free components that the asker lacks
    Candidate const* held = nullptr;        // a component of the group that only other sessions have bound; null if there is none
};

class Candidate {
public:
    virtual ~Candidate() = default;

    // Returns the values of a reference; empty if it has no value, nullopt if the value is not known yet.
    virtual std::optional<Texts> texts(Reference const&) const = 0;
    virtual std::optional<Positions> positions(Reference const&) const = 0;

    // Returns whether the candidate has this property, with or without a value.
    virtual bool has(Reference const&) const = 0;

    // The name that a ResourceId condition compares; empty if the candidate has no name.
    virtual std::string_view rid() const = 0;

    // All components of the candidate's robot (its engine); empty if it belongs to none.
    virtual std::vector<Candidate const*> robot() const = 0;

    // The cache for the result of a group condition about the candidate's robot. Null if the candidate does not belong to a
    // robot.
    virtual std::optional<GroupVerdict>* verdict(void const* group) const = 0;

    // Candidates that are not components cannot be bound.
    virtual Holder holder() const { return Holder::nobody; }
};

// A component together with something else. Keeps a reference to the component.
class WithComponent : public Candidate {
public:
    explicit WithComponent(Candidate const& component) : component_{component} {}

    std::string_view rid() const final { return component_.rid(); }
    std::vector<Candidate const*> robot() const final { return component_.robot(); }
    std::optional<GroupVerdict>* verdict(void const* group) const final { return component_.verdict(group); }
    Holder holder() const final { return component_.holder(); }

protected:
    Candidate const& component() const { return component_; }

private:
    Candidate const& component_;
};

// A component, together with the results of one of its events or of its answer to a query. Keeps a reference to the results.
class MessageCandidate final : public WithComponent {
public:
    MessageCandidate(Candidate const& component, Results const& results) : WithComponent{component}, results_{results} {}

    std::optional<Texts> texts(Reference const&) const override;
    std::optional<Positions> positions(Reference const&) const override;
    bool has(Reference const&) const override;

private:
    Results const& results_;
};

// Results without a component. `id` is the id in the application's request.
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
