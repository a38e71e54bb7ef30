#include "command/sequences.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <set>
#include <variant>

#include "command/output/terminal.hpp"

namespace rois::command {

namespace {

void collect(std::vector<CommandUnit>& units, std::vector<CommandMessage*>& found) {
    for (auto& unit : units) {
        if (auto* const message = std::get_if<CommandMessage>(&unit.unit)) {
            found.push_back(message);
        } else if (auto* const concurrent = std::get_if<ConcurrentCommands>(&unit.unit)) {
            for (auto& branch : concurrent->branches) collect(branch.command_list, found);
        } else if (auto* const sequential = std::get_if<SequentialCommandUnit>(&unit.unit)) {
            collect(sequential->command_unit_list, found);
        } else if (auto* const parallel = std::get_if<ParallelCommandUnit>(&unit.unit)) {
            collect(parallel->command_unit_list, found);
        }
    }
}

// Waits for the ends of commands.
class Waiting {
public:
    Waiting(Context& context, std::vector<Awaited> awaited) : context_{context}, awaited_{std::move(awaited)} {}

    void wait() {
        auto& session = context_.session();
        while (!awaited_.empty()) {
            auto const update = session.next_update();
            if (session.interrupted()) throw Trouble{Exit::interrupted, ""};
            if (!update) throw Trouble{Exit::no_answer, "the connection has closed"};
            take(*update);
        }
        if (failure_) throw Trouble{*failure_};
    }

private:
    void take(Update const& update) {
        if (auto const* const news = std::get_if<News>(&update)) {
            if (auto const* const completed = std::get_if<Completed>(&news->notification)) end(*completed, *news);
            if (std::holds_alternative<ReceiveError>(news->notification)) report_error(context_, *news);
        } else if (auto const* const gap = std::get_if<Gap>(&update); gap != nullptr && gap->why == Gap::Why::new_session) {
            throw ended_with_session();
        }
    }

    void end(Completed const& completed, News const& news) {
        auto const found = std::ranges::find(awaited_, completed.command_id, &Awaited::id);
        if (found == awaited_.end()) return;
        auto& printer = context_.printer();
        bool const good = completed.status == CompletedStatus::ok;
        bool const human = printer.form() == Form::human;
        if (!human) printer.notification(news.notification, news.sequence);
        auto const reason = good ? std::string{} : reason_of(context_, completed.command_id);
        auto const separated = [&](char const* separator) { return reason.empty() ? "" : separator + reason; };
        auto const status = std::string{to_text(completed.status)};
        if (human)
            printer.text(found->label + "  " + painted(status, good ? Colour::good : Colour::bad, printer.coloured()) +
                         separated("  ") + "\n");
        // For people, the line above has the reason. The other forms print the notification, which has none.
        if (!good && !failure_)
            failure_.emplace(exit_of(completed.status), human ? "" : found->label + ": " + status + separated(": "));
        awaited_.erase(found);
    }

    Context& context_;
    std::vector<Awaited> awaited_;
    std::optional<Trouble> failure_;  // of the first command that failed
};

}  // namespace

std::vector<CommandMessage*> messages_of(CommandUnitSequence& sequence) {
    std::vector<CommandMessage*> found;
    collect(sequence.command_unit_list, found);
    return found;
}

CommandId fresh_command_id() {
    static auto const process = [] {
        std::random_device chance;
        char text[20];
        std::snprintf(text, sizeof text, "rois-%08x", static_cast<unsigned>(chance()));
        return std::string{text};
    }();
    static unsigned number = 0;
    return CommandId{process + "-" + std::to_string(++number)};
}

std::string reason_of(Context& context, CommandId const& id) {
    auto const answer = context.session().request(GetCommandResult{id, {}});
    auto const* const reply = std::get_if<Reply>(&answer);
    auto const* const results = reply != nullptr ? std::get_if<GetCommandResult::Reply>(reply) : nullptr;
    auto const* const reason = results != nullptr ? find(results->results.parameters, "reason") : nullptr;
    return reason != nullptr && !reason->values.empty() ? harmless(reason->values.front()) : std::string{};
}

Trouble ended_with_session() { return Trouble{Exit::aborted, "the session has ended, and its commands with it"}; }

void wait_for(Context& context, std::vector<Awaited> awaited) {
    context.keep_recording();
    Waiting{context, std::move(awaited)}.wait();
}

void run(Context& context, CommandUnitSequence sequence) {
    std::vector<Awaited> awaited;
    std::set<std::string> bound;
    for (auto* const message : messages_of(sequence)) {
        if (message->command_id.text.empty()) message->command_id = fresh_command_id();
        awaited.push_back({message->command_id, message->command_type + " " + message->component_ref.code});
        if (bound.insert(message->component_ref.code).second) context.bound(message->component_ref);
    }
    auto const& options = context.options();
    if (options.check_only) {
        context.ok(Execute{std::move(sequence), true});
        return context.printer().line("possible; nothing has run", "check", Json{{"possible", true}});
    }
    if (!options.wait) {
        context.show(Execute{std::move(sequence)});
        return;
    }
    context.ok(Execute{std::move(sequence)});
    auto const wait = [&] { wait_for(context, awaited); };
    if (!options.results) return wait();
    std::optional<Trouble> trouble;
    try {
        wait();
    } catch (Trouble const& error) {
        if (error.exit() == Exit::interrupted || error.exit() == Exit::no_answer) throw;
        trouble = error;
    }
    for (auto const& each : awaited) context.show(GetCommandResult{each.id, {}});
    if (trouble) throw Trouble{*trouble};
}

}  // namespace rois::command
