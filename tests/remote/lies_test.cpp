// Sub engines that do not do what they should.
#include "remote/two_engines.hpp"

namespace rois {

namespace {

struct ALyingSubEngine : testing::Test {
    TwoEngines engines{{navigation, speech}};
    Application desk = engines.main.connect();

    // Returns the components of the main engine after the sub engine has sent this profile.
    std::vector<std::string> after(std::function<void(GetProfile::Reply&)> const& change) {
        engines.falsify = [change](Reply& reply) {
            if (auto* profile = std::get_if<GetProfile::Reply>(&reply)) change(*profile);
        };
        engines.hall.change({}, {detection});
        engines.advance(1s);
        return desk.search();
    }
    std::string reported() { return engines.reported.empty() ? "" : engines.reported.back(); }
};

}  // namespace

TEST_F(ALyingSubEngine, IsLeftIfItSendsNoDocument) {
    engines.bind(desk, "hall.navigation");
    engines.inject("no document");
    EXPECT_THAT(reported(), testing::StartsWith("invalid document: expected an answer or a notification, not '"));
    engines.advance(1s);
    EXPECT_EQ(desk.status_of("hall.navigation"), "READY") << "there is a new session";
    EXPECT_EQ(engines.execute(desk, go("go", "hall.navigation")).return_code, ReturnCode::ok) << "the component is bound again";
}

TEST_F(ALyingSubEngine, UnrequestedAnswersAreIgnored) {
    engines.bind(desk, "hall.navigation");
    engines.asked();
    engines.inject(xml::encode(Reply{Disconnect::Reply{}}, "connect"));
    engines.inject(xml::encode(Reply{Resume::Reply{}}, "resume"));
    Connect::Reply connected;
    connected.session.text = "another";
    engines.inject(xml::encode(Reply{connected}, "connect"));
    engines.inject(xml::encode(Reply{Bind::Reply{}}, "7000"));
    EXPECT_THAT(engines.asked(), IsEmpty()) << "nothing is begun again";
    EXPECT_EQ(engines.execute(desk, go("go", "hall.navigation")).return_code, ReturnCode::ok);
    EXPECT_THAT(engines.hall["navigation"].calls, testing::Contains("start"));
}

TEST_F(ALyingSubEngine, IsLeftAtOnceIfItSendsNoMessage) {
    engines.cut(client::Failure::invalid);
    engines.advance(50ms);
    EXPECT_EQ(desk.status_of("hall.navigation"), "ERROR");
    engines.repair();
    engines.advance(2s);
    EXPECT_EQ(desk.status_of("hall.navigation"), "READY");
}

TEST_F(ALyingSubEngine, MayAnswerOutOfOrder) {
    engines.hold_back(true);
    auto const asked = engines.main.begin_to_say(desk.session, Query{"route", {}});
    auto const bound = engines.main.begin_to_say(desk.session, Bind{Application::identifier("hall.navigation")});
    engines.settle();
    engines.reverse_answers();
    engines.hold_back(false);
    engines.settle();
    EXPECT_EQ(std::get<Query::Reply>(std::get<Reply>(asked->said.value())).return_code, ReturnCode::ok);
    EXPECT_EQ(std::get<Bind::Reply>(std::get<Reply>(bound->said.value())).return_code, ReturnCode::ok);
    EXPECT_EQ(engines.execute(desk, go("go", "hall.navigation")).return_code, ReturnCode::ok);
}

TEST_F(ALyingSubEngine, EndsEachCommandOnce) {
    engines.bind(desk, "hall.navigation");
    engines.execute(desk, go("go", "hall.navigation"));
    for (auto const status : {CompletedStatus::error, CompletedStatus::ok}) {
        Completed completed;
        completed.command_id.text = "h1";
        completed.status = status;
        engines.inject(completed);
    }
    Completed unknown;
    unknown.command_id.text = "never";
    engines.inject(unknown);
    EXPECT_THAT(desk.received(), ElementsAre(HasSubstr("completed go ERROR")));
}

TEST_F(ALyingSubEngine, EventsThatItsProfileLacksAreDropped) {
    desk.subscribe("reached_target");
    ReceiveEvent event;
    event.event_id.text = "e1";
    event.component_ref.code = "elevator";
    event.event_type = "reached_target";
    event.results = std::make_shared<Results const>();
    engines.inject(event);
    EXPECT_THAT(desk.received(), IsEmpty()) << "of a component that it does not have";
    event.component_ref.code = "navigation";
    event.results = std::make_shared<Results const>(Results{{value("wrong", "int", {"1"})}, {}});
    engines.inject(event);
    EXPECT_THAT(desk.received(), testing::Each(testing::Not(HasSubstr("reached_target"))));
    ComponentChanged changed;
    changed.component_ref.code = "elevator";
    engines.inject(changed);
    EXPECT_EQ(desk.search().size(), 2u);
}

TEST_F(ALyingSubEngine, IsRefusedWithInvalidNames) {
    EXPECT_THAT(after([](auto& profile) { profile.components[0].ref = "other.navigation"; }), IsEmpty());
    EXPECT_EQ(reported(), "its component 'other.navigation' has a dot in its name, and is not of an engine with such a name");
}

TEST_F(ALyingSubEngine, IsRefusedWithLongNames) {
    EXPECT_THAT(after([](auto& profile) { profile.components[0].ref = std::string(300, 'x'); }), IsEmpty());
    EXPECT_THAT(reported(), HasSubstr("has a name of 300 characters: expected at most 251"));
}

TEST_F(ALyingSubEngine, IsRefusedWithTwoComponentsOfOneName) {
    EXPECT_THAT(after([](auto& profile) { profile.components.push_back(profile.components[0]); }), IsEmpty());
    EXPECT_THAT(reported(), HasSubstr("it has two components with the ref 'detection'"));
}

TEST_F(ALyingSubEngine, IsRefusedWithTooManyComponents) {
    auto const many = [](auto& profile) {
        auto const one = profile.components[0];
        for (int i = 0; i < 1'000; ++i) profile.components.emplace_back(one).ref = "c" + std::to_string(i);
    };
    EXPECT_THAT(after(many), IsEmpty());
    EXPECT_EQ(reported(), "it has more than 1000 components");
}

TEST_F(ALyingSubEngine, IsRefusedWithAComponentOfTooManyParameters) {
    auto const many = [](auto& reply) {
        auto changed = *reply.components[1].profile;
        auto const one = changed.parameters.at(0);
        for (int i = 0; i < 500; ++i) changed.parameters.emplace_back(one).name = "p" + std::to_string(i);
        reply.components[1].profile = std::make_shared<ComponentProfile const>(changed);
    };
    EXPECT_THAT(after(many), IsEmpty());
    EXPECT_THAT(reported(), HasSubstr("messages, arguments, results and parameters: expected at most 500"));
}

TEST_F(ALyingSubEngine, IsRefusedWithALongDocument) {
    after([](auto& reply) {
        auto changed = *reply.components[0].profile;
        changed.object.description = std::string(5'000'000, 'x');
        reply.components[0].profile = std::make_shared<ComponentProfile const>(changed);
    });
    EXPECT_THAT(reported(), HasSubstr("bytes: expected at most 4000000 (longest_document)"));
    engines.advance(31s);
    EXPECT_THAT(desk.search(), IsEmpty());
}

TEST_F(ALyingSubEngine, IsRefusedWithMoreThanEightLevels) {
    auto const deep = [](auto& profile) {
        auto whole = *profile.profile;
        for (int i = 0; i < 8; ++i) {
            EngineProfile outer = whole;
            outer.sub_profiles = {whole};
            whole = outer;
        }
        profile.profile = std::make_shared<EngineProfile const>(whole);
    };
    EXPECT_THAT(after(deep), IsEmpty());
    EXPECT_EQ(reported(), "its engines have more than 8 levels");
}

// The engine that is asked is the first level.
TEST_F(ALyingSubEngine, MayHaveEightLevelsAndRobots) {
    auto const deep = [](auto& profile) {
        auto whole = *profile.profile;
        auto& robot = whole.sub_profiles.emplace_back(whole);
        robot.object.name += ".robot1";
        robot.components.clear();
        for (auto& parameter : robot.parameters)
            if (parameter.name == "instance") *parameter.default_value += ".robot1";
        for (int i = 0; i < 6; ++i) {
            EngineProfile outer = whole;
            outer.sub_profiles = {whole};
            whole = outer;
        }
        profile.profile = std::make_shared<EngineProfile const>(whole);
    };
    EXPECT_THAT(after(deep), testing::Not(IsEmpty()));
}

TEST_F(ALyingSubEngine, IsRefusedWithMoreThanFiveHundredEngines) {
    auto const many = [](auto& profile) {
        auto whole = *profile.profile;
        for (int i = 0; i < 500; ++i) whole.sub_profiles.emplace_back().object.name = "room" + std::to_string(i);
        profile.profile = std::make_shared<EngineProfile const>(whole);
    };
    EXPECT_THAT(after(many), IsEmpty());
    EXPECT_EQ(reported(), "it has more than 500 engines and robots");
}

TEST_F(ALyingSubEngine, WaitsIfItReportsMoreThanThisEngineHandles) {
    desk.subscribe("reached_target");
    for (int i = 0; i < 900; ++i)
        engines.hall["navigation"].fires("reached_target", {value("is_final_target", "bool", {"true"})});
    engines.hall.engine->and_work([] {}, engines.hall.now);
    engines.receive_without_main();
    EXPECT_FALSE(engines.is_paused());
    for (int i = 0; i < 300; ++i)
        engines.hall["navigation"].fires("reached_target", {value("is_final_target", "bool", {"true"})});
    engines.hall.engine->and_work([] {}, engines.hall.now);
    engines.receive_without_main();
    EXPECT_TRUE(engines.is_paused());
    engines.advance(1s);
    EXPECT_FALSE(engines.is_paused());
}

TEST_F(ALyingSubEngine, WaitsIfItSendsTooManyNotificationsASecond) {
    desk.subscribe("reached_target");
    auto const fire = [&](int times) {
        for (int i = 0; i < times; ++i)
            engines.hall["navigation"].fires("reached_target", {value("is_final_target", "bool", {"true"})});
        engines.settle();
    };
    for (int i = 0; i < 20; ++i) {  // 4,000 a second
        fire(200);
        EXPECT_FALSE(engines.is_paused());
        engines.advance(50ms);
    }
    for (int i = 0; i < 12; ++i) fire(100);
    EXPECT_TRUE(engines.is_paused());
    engines.advance(50ms);
    EXPECT_FALSE(engines.is_paused());
}

TEST_F(ALyingSubEngine, MayChangeAProfileWhileACommandRuns) {
    engines.bind(desk, "hall.navigation");
    engines.execute(desk, go("go", "hall.navigation"));
    after([](auto& reply) {
        for (auto& entry : reply.components) {
            auto changed = *entry.profile;
            changed.object.description = "another";
            entry.profile = std::make_shared<ComponentProfile const>(changed);
        }
    });
    EXPECT_THAT(desk.received(), testing::Contains(HasSubstr("completed go ABORT")));
    EXPECT_THAT(engines.hall["navigation"].calls, testing::Contains("halt"));
    EXPECT_EQ(desk.search().size(), 3u);
}

}  // namespace rois
