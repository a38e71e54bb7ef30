#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "files/files.hpp"
#include "fuzzing/targets.hpp"
#include "journal/journal_file.hpp"
#include "journal/records.hpp"
#include "xml/validation/schemas.hpp"

namespace rois::fuzzing {

namespace {

void expect_one_line(std::exception const& refused) {
    if (std::string_view{refused.what()}.find('\n') != std::string_view::npos)
        throw std::logic_error{std::string{"the refusal has several lines: "} + refused.what()};
}

// A folder for all inputs, removed at the end.
class Folder {
public:
    Folder() {
        if (::mkdtemp(name_.data()) == nullptr) throw std::runtime_error{"no folder"};
    }
    ~Folder() {
        std::error_code ignored;
        std::filesystem::remove_all(name_, ignored);
    }
    std::string const& name() const { return name_; }

private:
    std::string name_ = "/tmp/rois-fuzzing-XXXXXX";
};

// Takes the text before the next tab.
std::string_view next(std::string_view& line) {
    auto const end = std::min(line.find('\t'), line.size());
    auto const part = line.substr(0, end);
    line.remove_prefix(std::min(end + 1, line.size()));
    return part;
}

}  // namespace

// The input is the file of a journal; behind a mark, SQLite's log. A record that is read was written so: each has its
// checksum.
void journals(std::string_view input) {
    static Folder const folder;
    constexpr std::string_view mark = "\n-wal-\n";
    auto const end = std::min(input.find(mark), input.size());
    for (auto const* rest : {"-wal", "-journal"}) std::filesystem::remove(folder.name() + "/journal.db" + rest);
    std::ofstream{folder.name() + "/journal.db", std::ios::binary} << input.substr(0, end);
    if (end < input.size()) std::ofstream{folder.name() + "/journal.db-wal", std::ios::binary} << input.substr(end + mark.size());
    try {
        journal::JournalFile file{folder.name(), std::size_t{64} << 20};
        static_cast<void>(file.read());
    } catch (journal::BadJournal const& refused) {
        expect_one_line(refused);
    }
}

// Each line of the input is a record: its kind, session, key and value, with tabs between them. What can be read can be written,
// and reads as the same again.
void records(std::string_view input) {
    static xml::Platform const platform;
    static auto const schemas = std::make_shared<xml::Schemas const>(files::schemas());
    std::vector<journal::Record> all;
    while (!input.empty()) {
        auto const end = std::min(input.find('\n'), input.size());
        auto line = input.substr(0, end);
        input.remove_prefix(std::min(end + 1, input.size()));
        auto& record = all.emplace_back();
        record.key.kind = next(line);
        auto const session = next(line);
        std::from_chars(session.data(), session.data() + session.size(), record.key.session);
        record.key.key = next(line);
        record.value = line;
    }
    try {
        auto state = journal::state_of(all, schemas);
        Changes const changes{.engine = state.engine,
                              .sessions = state.sessions,
                              .subscriptions = state.subscriptions,
                              .commands = state.commands,
                              .notifications = state.notifications};
        static_cast<void>(journal::state_of(journal::records_of(changes).set, schemas));
    } catch (journal::BadRecord const& refused) {
        expect_one_line(refused);
    }
}

}  // namespace rois::fuzzing
