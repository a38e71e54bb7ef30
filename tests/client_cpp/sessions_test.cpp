// Sessions that several programs share, and the end of a session.
#include "client_cpp/rig.hpp"

namespace rois::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Key;
using testing::Not;
using testing::SizeIs;

class TheSession : public BothWays {
protected:
    // Settings that join the session of `holder`.
    Settings beside(Blocking& holder) const {
        auto joining = settings();
        joining.session = holder.client().session().text;
        return joining;
    }
};
ROIS_BOTH_WAYS(TheSession);

TEST_P(TheSession, IsSharedWithAProgramThatKnowsItsId) {
    History history;
    Blocking holder{settings(), history.observers()};
    auto const detection = holder.bind<PersonDetection>("person_detection");
    EXPECT_EQ(holder(detection.start()), CompletedStatus::ok);
    {
        History guest_history;
        Blocking guest{beside(holder), guest_history.observers()};
        guest.open();
        EXPECT_EQ(guest.client().session(), holder.client().session());
        auto const same = guest.client().component("person_detection");
        EXPECT_EQ(guest(same.stop()), CompletedStatus::ok) << "it is bound in this session";
        EXPECT_THAT(guest_history.completions(), SizeIs(2)) << "earlier notifications are received first";
    }
    EXPECT_EQ(holder(detection.start()), CompletedStatus::ok) << "the session goes on";
    EXPECT_THAT(history.completions(), SizeIs(3));
    EXPECT_THAT(history.states(), ElementsAre("connecting", "open"));
}

TEST_P(TheSession, ClosesTheConnectionsThatShareItWhenItEnds) {
    History guest_history;
    std::optional<Blocking> holder{settings()};
    holder->open();
    Blocking guest{beside(*holder), guest_history.observers()};
    guest.open();
    holder.reset();
    guest_history.await_states({"connecting", "open", "lost", "closed"});
    EXPECT_THAT(guest.call(Search{}).reason, HasSubstr("the session does not exist"));
}

TEST_P(TheSession, IsNotOpenedForAProgramThatJoins) {
    auto joining = settings();
    joining.session = "nobody";
    History guest_history;
    Blocking guest{joining, guest_history.observers()};
    try {
        guest.open();
        ADD_FAILURE() << "it is open";
    } catch (Error const& refused) {
        EXPECT_THAT(refused.what(), HasSubstr("the session does not exist"));
    }
    EXPECT_THAT(guest_history.states(), ElementsAre("connecting", "closed"));
}

TEST_P(TheSession, ReportsTheEndOfItsCommandsBeforeItsOwnEnd) {
    for (auto const ends_it : {true, false}) {
        History history;
        std::string id;
        {
            Blocking robot{settings(), history.observers()};
            auto const follow = robot.bind<Follow>("follow");
            auto const following =
                robot(follow.begin_following(FollowParameters().with_target_object_ref("nobody").with_distance(500_mm)));
            id = following.id().text;
            if (ends_it) robot.call(Disconnect{});
        }
        EXPECT_THAT(history.completions(), ElementsAre(testing::Pair(id, 1)));
        EXPECT_EQ(history.states().back(), "closed");
    }
}

}  // namespace
}  // namespace rois::test
