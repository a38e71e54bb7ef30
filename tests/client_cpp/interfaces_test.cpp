// The interfaces by the specification's names, and what the engine tells on its own.
#include "rois/interfaces.hpp"
#include "client_cpp/rig.hpp"

namespace rois::test {
namespace {

using namespace RoIS_HRI;
using testing::Contains;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

Identifier ref_of(std::string code) { return {std::move(code), {}, {}, {}}; }

// An application that remembers what it was told.
class Application : public RoIS_Service::ServiceApplicationBase {
public:
    void receive_event(EventId const& event_id, std::string const& event_type, SubscribeId const& subscribe_id,
                       RoIS_HRI::DateTime) override {
        note(event_type, {event_id.text, subscribe_id.text});
    }
    void receive_error(ErrorId const& error_id, RoIS_Service::ErrorType error_type) override {
        note(std::string{to_text(static_cast<ErrorType>(error_type))}, {error_id.text});
    }
    void completed(CommandId const& command_id, RoIS_Service::Completed_Status status) override {
        note("completed " + command_id.text, {std::string{to_text(static_cast<CompletedStatus>(status))}});
    }

    // Waits until it was told this; its ids, or its status.
    std::vector<std::string> await(std::string const& what) {
        std::unique_lock lock{mutex_};
        EXPECT_TRUE(news_.wait_for(lock, 20s, [&] { return told_.contains(what); })) << what;
        return told_[what];
    }

private:
    void note(std::string what, std::vector<std::string> more) {
        std::lock_guard const lock{mutex_};
        told_.emplace(std::move(what), std::move(more));
        news_.notify_all();
    }

    std::mutex mutex_;
    std::condition_variable news_;
    std::map<std::string, std::vector<std::string>> told_;
};

class TheInterfaces : public BothWays {
protected:
    Application application;
    Connection connection{settings(), application.observers()};
    SystemIF system{connection};
    CommandIF command{connection};
    QueryIF query{connection};
    EventIF event{connection};
};
ROIS_BOTH_WAYS(TheInterfaces);

TEST_P(TheInterfaces, SystemIF) {
    EXPECT_EQ(system.connect(), ReturnCode_t::OK);
    HRI_Engine_Profile profile;
    EXPECT_EQ(system.get_profile(type == "Move", profile), ReturnCode_t::OK);
    EXPECT_THAT(profile.components, ElementsAre(Field(&ComponentEntry::ref, "move")));
    ResultList results;
    EXPECT_EQ(system.get_error_detail({"nobody"}, {}, results), ReturnCode_t::BAD_PARAMETER);
    EXPECT_THAT(system.reason(), HasSubstr("nobody"));
    EXPECT_EQ(system.disconnect(), ReturnCode_t::OK);
    EXPECT_EQ(system.connect(), ReturnCode_t::ERROR);
    EXPECT_THAT(system.reason(), HasSubstr("closed"));
}

TEST_P(TheInterfaces, CommandIF) {
    RoIS_IdentifierList found;
    EXPECT_EQ(command.search(type == "SpeechSynthesis", found), ReturnCode_t::OK);
    ASSERT_THAT(found, ElementsAre(Field(&Identifier::code, "speech_synthesis")));
    EXPECT_EQ(command.bind(found[0]), ReturnCode_t::OK);
    rois::CommandId id;
    EXPECT_EQ(command.set_parameter(found[0], {text("speech_text", "Hello.")}, id), ReturnCode_t::OK);
    EXPECT_THAT(application.await("completed " + id.text), ElementsAre("OK"));
    ParameterList parameters;
    EXPECT_EQ(command.get_parameter(found[0], parameters), ReturnCode_t::OK);
    EXPECT_THAT(parameters, Contains(Field(&Parameter::values, ElementsAre("Hello."))));
    CommandUnitSequence sequence;
    sequence.command_unit_list.push_back({{}, CommandMessage{found[0], "start", {}, {text("speech_text", "Hi.")}}});
    EXPECT_EQ(command.execute(sequence), ReturnCode_t::OK);
    id = std::get<CommandMessage>(sequence.command_unit_list.at(0).unit).command_id;
    EXPECT_THAT(application.await("completed " + id.text), ElementsAre("OK"));
    ResultList results;
    EXPECT_EQ(command.get_command_result(id, {}, results), ReturnCode_t::OK);
    EXPECT_THAT(results.parameters, Contains(Field(&Parameter::values, ElementsAre("OK"))));
    EXPECT_EQ(command.release(found[0]), ReturnCode_t::OK);
    Identifier any;
    EXPECT_EQ(command.bind_any(type == "Move", any), ReturnCode_t::OK);
    EXPECT_EQ(any.code, "move");
    EXPECT_EQ(command.release(any), ReturnCode_t::OK);
}

TEST_P(TheInterfaces, QueryIF) {
    ResultList results;
    EXPECT_EQ(query.query("component_status", component_ref == "move", results), ReturnCode_t::OK);
    EXPECT_THAT(results.parameters, ElementsAre(Field(&Parameter::values, ElementsAre("READY"))));
}

TEST_P(TheInterfaces, EventIF) {
    rois::SubscribeId subscribed;
    EXPECT_EQ(event.subscribe("person_detected", result("number") >= 0, subscribed), ReturnCode_t::OK);
    EXPECT_EQ(command.bind(ref_of("person_detection")), ReturnCode_t::OK);
    CommandUnitSequence sequence;
    sequence.command_unit_list.push_back({{}, CommandMessage{ref_of("person_detection"), "start", {}, {}}});
    EXPECT_EQ(command.execute(sequence), ReturnCode_t::OK);
    auto const ids = application.await("person_detected");
    EXPECT_EQ(ids.at(1), subscribed.text);
    ResultList results;
    EXPECT_EQ(event.get_event_detail({ids.at(0)}, {}, results), ReturnCode_t::OK);
    EXPECT_NE(find(results.parameters, "number"), nullptr);
    EXPECT_EQ(event.unsubscribe(subscribed), ReturnCode_t::OK);
}

TEST_P(TheInterfaces, OfEachComponent) {
    RoIS_Common::Query query_of{connection, ref_of("person_detection")};
    RoIS_Common::Component_Status status{};
    EXPECT_EQ(query_of.component_status(status), OK);
    EXPECT_EQ(status, RoIS_Common::READY);
    RoIS_Common::Command detection{connection, ref_of("person_detection")};
    EXPECT_EQ(detection.start(), ERROR) << "it is not bound";
    EXPECT_THAT(detection.reason(), HasSubstr("person_detection"));
    EXPECT_EQ(command.bind(ref_of("person_detection")), OK);
    for (auto const function : {&RoIS_Common::Command::start, &RoIS_Common::Command::suspend, &RoIS_Common::Command::resume,
                                &RoIS_Common::Command::stop}) {
        EXPECT_EQ((detection.*function)(), OK);
        EXPECT_THAT(application.await("completed " + detection.command_id().text), ElementsAre("OK"));
    }
    RoIS_Common::Query nobodys{connection, ref_of("nobody")};
    EXPECT_NE(nobodys.component_status(status), OK);
    EXPECT_EQ(status, RoIS_Common::READY) << "as it was";
    EXPECT_EQ(command.release(ref_of("person_detection")), OK);
}

// As an unscoped enumeration gives them: with and without its name.
TEST(TheNames, AreThoseOfTheSpecification) {
    EXPECT_EQ(RoIS_HRI::OK, RoIS_HRI::ReturnCode_t::OK);
    EXPECT_EQ(RoIS_HRI::TIMEOUT, 5);
    EXPECT_EQ(RoIS_Service::ABORT, RoIS_Service::Completed_Status::ABORT);
    EXPECT_EQ(RoIS_Service::USER_DEFINED_ERROR, 3);
    RoIS_HRI::Integer const number = 7;
    RoIS_HRI::Parameter const parameter = integer("number", number);
    RoIS_HRI::Result const result = parameter;
    RoIS_HRI::Argument const argument = result;
    EXPECT_EQ(argument.values, std::vector<std::string>{"7"});
    EXPECT_EQ(RoIS_HRI::DateTime{}, Utc{});
    [[maybe_unused]] RoIS_Common::Event const none;
}

TEST_P(TheInterfaces, LeaveWhatTheyWouldGiveAsItIsWhenRefused) {
    Identifier any = ref_of("as it was");
    EXPECT_EQ(command.bind_any(type == "Elevator", any), ReturnCode_t::UNSUPPORTED);
    EXPECT_EQ(any.code, "as it was");
    EXPECT_THAT(command.reason(), testing::Not(""));
    RoIS_IdentifierList found{any};
    EXPECT_EQ(command.search(Reference{"colour"} == "red", found), ReturnCode_t::BAD_PARAMETER);
    EXPECT_THAT(found, SizeIs(1));
    EXPECT_EQ(command.search({}, found), ReturnCode_t::OK);
    EXPECT_EQ(command.reason(), "") << "of the last one";
    ResultList results;
    EXPECT_EQ(query.query("weather", {}, results), ReturnCode_t::UNSUPPORTED);
    EXPECT_THAT(results.parameters, IsEmpty());
}

TEST(TheServiceApplication, ReceivesErrors) {
    GatewayProcess const gateway{{"--scenario", ROIS_SOURCE_DIR "/tests/server/data/unwell.xml"}};
    Application application;
    Connection connection{quick(gateway.url()), application.observers()};
    CommandIF command{connection};
    EXPECT_EQ(command.bind(ref_of("navigation")), ReturnCode_t::OK);
    CommandUnitSequence sequence;
    sequence.command_unit_list.push_back(
        {{}, CommandMessage{ref_of("navigation"), "start", {"go"}, {texts("target_position", {"desk"})}}});
    EXPECT_EQ(command.execute(sequence), ReturnCode_t::OK);
    EXPECT_THAT(application.await("completed go"), ElementsAre("ERROR"));
    auto const error = application.await("COMPONENT_INTERNAL_ERROR");
    ResultList results;
    EXPECT_EQ(SystemIF{connection}.get_error_detail({error.at(0)}, {}, results), ReturnCode_t::OK);
    EXPECT_THAT(results.parameters, Contains(Field(&Parameter::values, ElementsAre("navigation"))));
}

}  // namespace
}  // namespace rois::test
