// Lists of units become persons: who is the same, names, translation, bad input.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "choosing/simulator.hpp"

namespace rois::choosing::stage {
namespace {

using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Matrix round_covariance(double deviation) { return Matrix::Identity() * deviation * deviation; }

// Persons on given paths, and units that list them ten times per second, without noise.
class Fusing : public testing::Test {
protected:
    struct Seen {
        std::string name;
        Vector position;
    };

    Received list(std::string const& unit, std::vector<Seen> const& persons, double deviation = 0.05) {
        std::vector<Sighting> sightings;
        sightings.reserve(persons.size());
        for (auto const& [name, position] : persons) sightings.push_back({name, position, {}, round_covariance(deviation)});
        return fusion.sensed(unit, after(time), sightings);
    }

    // Calls `lists` ten times per second.
    void repeat(double seconds, std::function<void()> const& lists) {
        for (int i = 0; i < static_cast<int>(std::lround(seconds * 10)); ++i) {
            time += 0.1;
            lists();
            fusion.advance(after(time));
        }
    }

    std::vector<FusedPerson> persons() const { return fusion.persons(after(time)); }

    std::vector<std::string> changes() {
        std::vector<std::string> all;
        for (auto const& [kind, name, merged_into] : fusion.take_changes()) {
            std::string& text = all.emplace_back(kind == Change::Kind::appeared ? "+" : "-");
            text.append(name);
            if (!merged_into.empty()) text.append(">").append(merged_into);
        }
        return all;
    }

    std::string own(std::string const& unit, std::string const& name) const { return fusion.own_name(unit, name).value_or("?"); }

    Fusion fusion;
    double time = 0;
};

TEST_F(Fusing, APersonOfOneUnitAppearsAtOnce) {
    list("robot1", {{"p", {1, 2}}});
    ASSERT_THAT(persons(), SizeIs(1));
    EXPECT_EQ(persons()[0].name, "person-1");
    EXPECT_LT((persons()[0].position - Vector{1, 2}).norm(), 1e-9);
    EXPECT_THAT(persons()[0].sensed_by, ElementsAre(SensedBy{"robot1", "p"}));
    EXPECT_THAT(changes(), ElementsAre("+person-1"));
}

TEST_F(Fusing, ASecondUnitsPersonNearbyIsMergedAfterHalfASecondAndNeverAppears) {
    auto const both = [&] {
        list("robot1", {{"p", {1, 2}}});
        list("robot2", {{"q", {1.1, 2}}});
    };
    repeat(0.4, both);
    EXPECT_EQ(own("robot2", "q"), "?") << "not yet decided";
    EXPECT_THAT(persons(), SizeIs(1));
    repeat(0.3, both);
    EXPECT_EQ(own("robot2", "q"), "person-1");
    EXPECT_THAT(persons()[0].sensed_by, ElementsAre(SensedBy{"robot1", "p"}, SensedBy{"robot2", "q"}));
    EXPECT_NEAR(persons()[0].position.x(), 1.05, 0.01);
    EXPECT_THAT(changes(), ElementsAre("+person-1"));
}

TEST_F(Fusing, SilentUnitsAreMergedToo) {
    list("robot1", {{"p", {1, 2}}});
    list("robot2", {{"q", {1.1, 2}}});
    repeat(1, [] {});
    EXPECT_EQ(own("robot2", "q"), "person-1");
}

TEST_F(Fusing, PersonsBeyondThreeSigmaAreDifferent) {
    repeat(3, [&] {
        list("robot1", {{"p", {1, 2}}});
        list("robot2", {{"p", {1.3, 2}}});
    });
    EXPECT_THAT(persons(), SizeIs(2));
    EXPECT_NE(own("robot1", "p"), own("robot2", "p"));
}

TEST_F(Fusing, AMergedPairStaysMergedUntilItLiesClearlyApartForHalfASecond) {
    auto const apart = [&](double distance) {
        return [this, distance] {
            list("robot1", {{"p", {1, 2}}});
            list("robot2", {{"q", {1 + distance, 2}}});
        };
    };
    repeat(1, apart(0.1));
    repeat(10, apart(0.32));
    EXPECT_THAT(persons(), SizeIs(1)) << "beyond three sigma, but merged";
    repeat(0.3, apart(0.6));
    EXPECT_THAT(persons(), SizeIs(1)) << "not for half a second yet";
    repeat(0.7, apart(0.6));
    EXPECT_THAT(persons(), SizeIs(2));
    EXPECT_EQ(own("robot1", "p"), "person-1") << "the first one keeps the name";
    EXPECT_THAT(changes(), ElementsAre("+person-1", "+person-2"));
}

TEST_F(Fusing, TheMajorityKeepsTheNameWhenOneUnitLeavesIt) {
    auto const lists = [&](double x) {
        return [this, x] {
            list("robot1", {{"p", {x, 2}}});
            list("robot2", {{"q", {1, 2}}});
            list("robot3", {{"r", {1, 2}}});
        };
    };
    repeat(2, lists(1));
    ASSERT_THAT(persons(), SizeIs(1));
    repeat(2, lists(2));
    EXPECT_EQ(own("robot2", "q"), "person-1");
    EXPECT_EQ(own("robot3", "r"), "person-1");
    EXPECT_EQ(own("robot1", "p"), "person-2");
}

TEST_F(Fusing, PersonsWhomOneUnitListsSeparatelyAreNeverMerged) {
    repeat(5, [&] {
        list("robot1", {{"p", {1, 2}}, {"q", {1.05, 2}}});
        list("robot2", {{"r", {1, 2.05}}, {"s", {1.05, 2.05}}});
        list("robot3", {{"t", {1, 2}}, {"u", {1, 2}}});
    });
    EXPECT_THAT(persons(), SizeIs(2));
    for (auto const& person : persons()) EXPECT_THAT(person.sensed_by, SizeIs(3));
}

TEST_F(Fusing, OneUnitsTwoNamesForOnePlaceStayTwoPersons) {
    repeat(3, [&] { list("robot1", {{"p", {1, 2}}, {"q", {1, 2}}}); });
    EXPECT_THAT(persons(), SizeIs(2));
}

TEST_F(Fusing, EqualNamesDoNotMakeDifferentPersonsTheSame) {
    repeat(3, [&] {
        list("robot1", {{"person-1", {1, 2}}, {"person-2", {5, 2}}});
        list("robot2", {{"person-2", {1, 2}}, {"person-1", {5, 2}}});
        list("robot3", {{"person-1", {9, 2}}});
    });
    EXPECT_THAT(persons(), SizeIs(3));
    EXPECT_EQ(own("robot1", "person-1"), own("robot2", "person-2"));
    EXPECT_EQ(own("robot1", "person-2"), own("robot2", "person-1"));
    EXPECT_NE(own("robot3", "person-1"), own("robot1", "person-1"));
}

TEST_F(Fusing, AUnitsNameThatJumpsMeansAnotherPerson) {
    repeat(1, [&] { list("robot1", {{"p", {1, 2}}}); });
    repeat(1, [&] { list("robot1", {{"p", {6, 2}}}); });
    EXPECT_EQ(own("robot1", "p"), "person-2");
    repeat(5, [&] { list("robot1", {{"p", {6, 2}}}); });
    EXPECT_THAT(changes(), ElementsAre("+person-1", "+person-2", "-person-1"));
}

TEST_F(Fusing, TheBestPairingIsChosenNotTheFirst) {
    // Greedy, q2 would take p1, which is nearest, and q1 would be left alone.
    repeat(2, [&] {
        list("robot1", {{"p1", {1.0, 2}}, {"p2", {1.3, 2}}}, 0.1);
        list("robot2", {{"q2", {1.16, 2}}, {"q1", {0.7, 2}}}, 0.1);
    });
    EXPECT_EQ(own("robot1", "p1"), own("robot2", "q1"));
    EXPECT_EQ(own("robot1", "p2"), own("robot2", "q2"));
}

TEST_F(Fusing, AWrongPairIsCorrectedWhenTheRightPartnerComesIntoView) {
    repeat(2, [&] {
        list("robot1", {{"p1", {1.0, 2}}}, 0.1);
        list("robot2", {{"q2", {1.4, 2}}}, 0.1);
    });
    ASSERT_EQ(own("robot1", "p1"), own("robot2", "q2")) << "within three sigma, and no other explanation";
    repeat(3, [&] {
        list("robot1", {{"p1", {1.0, 2}}, {"p2", {1.4, 2}}}, 0.1);
        list("robot2", {{"q2", {1.4, 2}}}, 0.1);
    });
    EXPECT_EQ(own("robot1", "p1"), "person-1");
    EXPECT_EQ(own("robot1", "p2"), own("robot2", "q2"));
}

TEST_F(Fusing, PersonsAtMirrorImagePositionsAreNotSwapped) {
    // Two robots face each other. Each numbers the persons from its left to its right. The persons approach each other and part.
    repeat(12, [&] {
        double const off = 0.3 + std::abs(time - 6) * 0.3;
        list("robot1", {{"person-1", {5, 3 + off}}, {"person-2", {5, 3 - off}}}, 0.1);
        list("robot2", {{"person-1", {5, 3 - off}}, {"person-2", {5, 3 + off}}}, 0.1);
    });
    EXPECT_THAT(persons(), SizeIs(2));
    EXPECT_EQ(own("robot1", "person-1"), own("robot2", "person-2"));
    EXPECT_EQ(own("robot1", "person-2"), own("robot2", "person-1"));
    EXPECT_EQ(own("robot1", "person-1"), "person-1");
}

// Two persons walk towards each other and pass at this distance.
class Passing : public Fusing, public testing::WithParamInterface<double> {
protected:
    Vector east() const { return {time * 1.4, 2}; }
    Vector west() const { return {14 - time * 1.4, 2 + GetParam()}; }
};

TEST_P(Passing, PersonsKeepTheirNames) {
    repeat(10, [&] {
        list("robot1", {{"e", east()}, {"w", west()}}, 0.2);
        list("robot2", {{"w", west()}, {"e", east()}}, 0.2);
    });
    EXPECT_THAT(persons(), SizeIs(2));
    EXPECT_EQ(own("robot1", "e"), "person-1");
    EXPECT_EQ(own("robot2", "e"), "person-1");
    EXPECT_EQ(own("robot1", "w"), "person-2");
    EXPECT_EQ(own("robot2", "w"), "person-2");
    EXPECT_THAT(changes(), ElementsAre("+person-1", "+person-2"));
}

TEST_P(Passing, PersonsOfWhomEachUnitSeesOneAreNotMerged) {
    repeat(10, [&] {
        list("robot1", {{"p", east()}}, 0.3);
        list("robot2", {{"p", west()}}, 0.3);
    });
    EXPECT_THAT(changes(), ElementsAre("+person-1", "+person-2"));
}

TEST_P(Passing, PersonsKeepTheirNamesWhileOneUnitLosesTheHiddenOne) {
    auto const hidden = [&] { return std::abs(east().x() - west().x()) < 0.5; };
    int lost = 0;
    repeat(10, [&] {
        lost += hidden();
        list("robot1", {{"e", east()}, {"w", west()}}, 0.1);
        std::vector<Seen> seen{{"e", east()}};
        if (!hidden()) seen.push_back({lost > 0 ? "w-again" : "w", west()});
        list("robot2", seen, 0.1);
    });
    EXPECT_EQ(own("robot2", "e"), "person-1");
    EXPECT_EQ(own("robot2", "w-again"), "person-2");
    EXPECT_THAT(changes(), ElementsAre("+person-1", "+person-2"));
}

INSTANTIATE_TEST_SUITE_P(AtDistance, Passing, testing::Values(0.4, 0.6, 1.0),
                         [](auto const& each) { return std::to_string(std::lround(each.param * 10)) + "Decimetres"; });

TEST_F(Fusing, APersonWhoWalksFromOneViewIntoTheOtherKeepsTheName) {
    auto const place = [&] { return Vector{time * 1.5, 2}; };
    repeat(6, [&] {
        list("robot1", place().x() < 5 ? std::vector<Seen>{{"p", place()}} : std::vector<Seen>{});
        list("robot2", place().x() > 4 ? std::vector<Seen>{{"q", place()}} : std::vector<Seen>{});
    });
    EXPECT_EQ(own("robot2", "q"), "person-1");
    EXPECT_THAT(changes(), ElementsAre("+person-1"));
}

TEST_F(Fusing, APersonWhoCrossesAGapBetweenTheViewsKeepsTheName) {
    auto const place = [&] { return Vector{time * 1.2, 2 + 0.1 * time}; };
    repeat(8, [&] {
        list("robot1", place().x() < 4 ? std::vector<Seen>{{"p", place()}} : std::vector<Seen>{});
        list("robot2", place().x() > 7 ? std::vector<Seen>{{"q", place()}} : std::vector<Seen>{});
    });
    EXPECT_EQ(own("robot2", "q"), "person-1");
}

TEST_F(Fusing, ALostPersonIsRememberedForFiveSeconds) {
    repeat(2, [&] { list("robot1", {{"p", {1, 2}}}); });
    repeat(4, [&] { list("robot1", {}); });
    ASSERT_THAT(persons(), SizeIs(1));
    EXPECT_THAT(persons()[0].sensed_by, IsEmpty());
    EXPECT_GT(persons()[0].covariance(0, 0), 1) << "no unit knows where the person is";
    repeat(1, [&] { list("robot1", {{"other-name", {1.2, 2}}}); });
    EXPECT_EQ(own("robot1", "other-name"), "person-1");
    repeat(6, [&] { list("robot1", {}); });
    EXPECT_THAT(persons(), IsEmpty());
    repeat(1, [&] { list("robot1", {{"p", {1, 2}}}); });
    EXPECT_THAT(changes(), ElementsAre("+person-1", "-person-1", "+person-2"));
}

TEST_F(Fusing, APersonWhoAppearsElsewhereIsNotTheLostOne) {
    repeat(2, [&] { list("robot1", {{"p", {1, 2}}}); });
    repeat(2, [&] { list("robot1", {}); });
    repeat(1, [&] { list("robot1", {{"p", {5, 6}}}); });
    EXPECT_EQ(own("robot1", "p"), "person-2");
}

TEST_F(Fusing, LostPersonsAreFoundAgainInTheBestPairing) {
    repeat(2, [&] { list("robot1", {{"p", {1, 2}}, {"q", {1.8, 2}}}); });
    repeat(2, [&] { list("robot1", {}); });
    repeat(1, [&] { list("robot2", {{"s", {1.7, 2}}, {"r", {0.6, 2}}}); });
    EXPECT_EQ(own("robot2", "r"), "person-1");
    EXPECT_EQ(own("robot2", "s"), "person-2");
}

TEST_F(Fusing, TheOtherUnitKeepsThePersonsOfALostUnit) {
    auto const both = [&] {
        list("robot1", {{"p", {1, 2}}, {"far", {8, 2}}});
        list("robot2", {{"q", {1, 2}}});
    };
    repeat(2, both);
    fusion.lost("robot1", after(time));
    repeat(4, [&] { list("robot2", {{"q", {1, 2}}}); });
    EXPECT_EQ(own("robot2", "q"), "person-1");
    EXPECT_EQ(own("robot1", "p"), "?");
    EXPECT_THAT(persons()[0].sensed_by, ElementsAre(SensedBy{"robot2", "q"}));
    repeat(2, [&] { list("robot2", {{"q", {1, 2}}}); });
    EXPECT_THAT(changes(), ElementsAre("+person-1", "+person-2", "-person-2"));
    fusion.lost("unknown", after(time));
}

TEST_F(Fusing, AListIsValidForItsLongestAge) {
    list("robot1", {{"p", {1, 2}}});
    repeat(9.8, [] {});
    EXPECT_THAT(persons()[0].sensed_by, SizeIs(1));
    EXPECT_LT(persons()[0].covariance(0, 0), 0.02) << "the person stands";
    repeat(0.4, [] {});
    EXPECT_THAT(persons()[0].sensed_by, IsEmpty());
}

TEST_F(Fusing, WalkingPersonsAreBroughtToOneTime) {
    // One unit is half a second late against the other.
    for (int i = 0; i < 20; ++i) {
        time = i * 0.5;
        if (i % 2 == 0) list("robot1", {{"p", {time * 2, 2}}});
        if (i % 2 == 1) list("robot2", {{"q", {time * 2, 2}}});
        fusion.advance(after(time));
    }
    EXPECT_EQ(own("robot2", "q"), own("robot1", "p"));
    EXPECT_NEAR(fusion.persons(after(time + 0.3))[0].position.x(), (time + 0.3) * 2, 0.1);
}

TEST_F(Fusing, NamesAreTranslatedInBothDirections) {
    repeat(2, [&] {
        list("robot1", {{"p", {1, 2}}});
        list("robot2", {{"q", {1, 2}}, {"r", {4, 4}}});
    });
    EXPECT_EQ(fusion.unit_name("person-1", "robot1"), "p");
    EXPECT_EQ(fusion.unit_name("person-1", "robot2"), "q");
    EXPECT_EQ(fusion.unit_name(own("robot2", "r"), "robot1"), std::nullopt);
    EXPECT_EQ(fusion.unit_name("person-77", "robot1"), std::nullopt);
    EXPECT_EQ(fusion.own_name("robot3", "p"), std::nullopt);
    EXPECT_EQ(fusion.own_name("robot1", "q"), std::nullopt);
}

TEST_F(Fusing, ZIsPassedThrough) {
    fusion.sensed("robot1", after(1), std::vector<Sighting>{{"p", {1, 2}, {1.7}}});
    EXPECT_EQ(fusion.persons(after(1))[0].details.z, 1.7);
}

TEST_F(Fusing, ThePrefixOfTheNamesIsASetting) {
    Fusion faces{{.prefix = "face-"}};
    faces.sensed("robot1", after(1), std::vector<Sighting>{{"p", {1, 2}}});
    EXPECT_EQ(faces.persons(after(1))[0].name, "face-1");
}

TEST_F(Fusing, PositionsWithoutACovarianceGetTheUnitsDefault) {
    fusion.configure("robot1", {.deviation = 0.3});
    fusion.sensed("robot1", after(1), std::vector<Sighting>{{"p", {1, 2}}});
    EXPECT_NEAR(fusion.persons(after(1))[0].covariance(0, 0), 0.09, 1e-4);
}

TEST_F(Fusing, InvalidCovariancesAreReplacedByTheDefault) {
    Matrix not_finite = round_covariance(1), negative = round_covariance(1), singular = Matrix::Ones(),
           skew = round_covariance(1);
    not_finite(0, 1) = nan;
    negative(1, 1) = -1;
    skew(0, 1) = 0.5;
    for (Matrix const& bad : {not_finite, negative, singular, skew, Matrix{Matrix::Zero()}, round_covariance(1000)}) {
        Fusion fresh;
        auto const received = fresh.sensed("robot1", after(1), std::vector<Sighting>{{"p", {1, 2}, {}, bad}});
        ASSERT_THAT(received.problems, SizeIs(1));
        EXPECT_THAT(received.problems[0].reason, HasSubstr("default is used"));
        EXPECT_NEAR(fresh.persons(after(1))[0].covariance(0, 0), 0.01, 1e-4);
    }
}

TEST_F(Fusing, InvalidSightingsAreIgnoredAndTheOthersAccepted) {
    std::vector<Sighting> const sightings{{"p", {nan, 2}}, {"q", {1, 1e9}}, {"", {1, 2}},
                                          {"r", {1, 2}},   {"r", {3, 2}},   {"s", {5, 5}, nan}};
    auto const received = fusion.sensed("robot1", after(1), sightings);
    EXPECT_EQ(received.outcome, Received::Outcome::accepted);
    EXPECT_THAT(received.problems, SizeIs(5));
    ASSERT_THAT(fusion.persons(after(1)), SizeIs(1));
    EXPECT_EQ(fusion.persons(after(1))[0].sensed_by[0].name, "r");
}

TEST_F(Fusing, OutdatedListsAreIgnored) {
    time = 2;
    list("robot1", {{"p", {1, 2}}});
    time = 1;
    EXPECT_EQ(list("robot1", {}).outcome, Received::Outcome::outdated);
    EXPECT_EQ(list("robot2", {{"q", {5, 5}}}).outcome, Received::Outcome::accepted) << "of another unit";
    EXPECT_THAT(fusion.persons(after(2)), SizeIs(2));
}

TEST_F(Fusing, AUnitHasAtMostAHundredPersons) {
    std::vector<Seen> many;
    many.reserve(130);
    for (int i = 0; i < 130; ++i) many.push_back({"p" + std::to_string(i), {i, 0}});
    auto const received = list("robot1", many);
    ASSERT_THAT(received.problems, SizeIs(1));
    EXPECT_EQ(received.problems[0].reason, "the list has 130 entries; only the first 100 count");
    EXPECT_THAT(persons(), SizeIs(100));
}

}  // namespace
}  // namespace rois::choosing::stage
