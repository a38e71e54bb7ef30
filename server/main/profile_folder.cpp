#include "main/profile_folder.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <stdexcept>
#include <utility>

#include "basic/adapters/adapters.hpp"
#include "basic/base/component_names.hpp"
#include "main/configuration_file.hpp"
#include "main/settings.hpp"
#include "types/text/texts.hpp"
#include "xml/profiles/profile_document.hpp"

namespace rois {

namespace {

using Verdict = ProfileFile::Verdict;

std::vector<std::filesystem::path> documents_in(std::string const& folder) {
    std::error_code error;
    std::vector<std::filesystem::path> documents;
    for (std::filesystem::directory_iterator at{folder, error}, end; !error && at != end; at.increment(error))
        if (at->path().extension() == ".xml") documents.push_back(at->path());
    if (error) throw BadSettings{folder + ": cannot be read: " + error.message()};
    std::ranges::sort(documents);
    return documents;
}

// A file, and the places in its document that error messages of later checks need.
struct Read {
    ProfileFile file;
    std::vector<std::string> sub_component_places;
    std::string adapter_place, identifier_place, name_place;
    bool is_idle = false;  // the gateway uses its built-in profile with this URN instead
};

void refuse(ProfileFile& file, std::string why) {
    file.verdict = Verdict::refused;
    file.findings = {std::move(why)};
    file.profile.reset();
}

void warn(ProfileFile& file, std::string what) {
    file.verdict = Verdict::warning;
    file.findings.push_back(std::move(what));
}

Read read(std::shared_ptr<xml::Schemas const> const& schemas, std::filesystem::path const& path) {
    Read read;
    read.file.name = path.filename();
    try {
        std::error_code error;
        if (!std::filesystem::is_regular_file(path, error)) throw BadSettings{read.file.name + ": not a regular file"};
        auto document = xml::read_profile_document(schemas, read.file.name, text_of_file(path));
        if (!document.warnings.empty()) read.file.verdict = Verdict::warning;
        read.file.findings = std::move(document.warnings);
        read.sub_component_places = std::move(document.sub_component_places);
        read.adapter_place = std::move(document.adapter_place);
        read.identifier_place = std::move(document.identifier_place);
        read.name_place = std::move(document.name_place);
        if (auto* const profile = std::get_if<ComponentProfile>(&document.profile)) read.file.profile = std::move(*profile);
    } catch (xml::BadDocument const& bad) {
        refuse(read.file, bad.what());
    } catch (BadSettings const& bad) {
        std::string why = bad.what();
        if (why.starts_with(path.string())) why.replace(0, path.string().size(), read.file.name);
        refuse(read.file, std::move(why));
    }
    return read;
}

std::string first_place(ProfileFile const& file) { return file.name + ":1:1: "; }

// Refuses a profile that an earlier file defines too. Ignores, with a warning, a profile that is built in.
void refuse_doubles(std::vector<Read>& all, std::vector<ComponentProfile> const& known) {
    for (auto each = all.begin(); each != all.end(); ++each) {
        if (!each->file.profile) continue;
        auto const& urn = each->file.profile->object.identifier;
        auto const same = [&](ComponentProfile const& p) { return equal_ignoring_case(p.object.identifier, urn); };
        auto const before =
            std::find_if(all.begin(), each, [&](Read const& r) { return r.file.profile && same(*r.file.profile); });
        if (before != each) {
            refuse(each->file,
                   first_place(each->file) + "the profile " + quoted(urn, 200) + " is in " + before->file.name + " already");
        } else if (std::ranges::any_of(known, same)) {
            each->is_idle = true;
            warn(each->file,
                 first_place(each->file) + "the gateway has a profile " + quoted(urn, 200) + " of its own, and uses that one");
        }
    }
}

std::vector<ComponentProfile> with_known(std::vector<Read> const& all, std::vector<ComponentProfile> const& known) {
    auto together = known;
    for (auto const& each : all)
        if (each.file.profile) together.push_back(*each.file.profile);
    return together;
}

// Returns why no component can be made from the profile, or nullopt. Called for each file, in order.
using Objection = std::function<std::optional<std::string>(Read const&, std::vector<ComponentProfile> const& known)>;

std::optional<std::string> includes_unknown(Read const& read, std::vector<ComponentProfile> const& known) {
    auto const& parts = read.file.profile->sub_components;
    for (std::size_t i = 0; i < parts.size(); ++i)
        if (find_parts(known, *read.file.profile, parts[i]).empty())
            return read.sub_component_places[i] + ": no component profile " + quoted(parts[i], 200) + " is known";
    return {};
}

std::optional<std::string> includes_itself(Read const& read, std::vector<ComponentProfile> const& known) {
    try {
        flattened(*read.file.profile, known);
        return {};
    } catch (std::runtime_error const& error) {
        return read.sub_component_places.front() + ": " + error.what();
    }
}

enum class Refused : std::uint8_t { none, some };

Refused refuse(std::vector<Read>& all, std::vector<ComponentProfile> const& known, Objection const& objection) {
    auto refused = Refused::none;
    auto const together = with_known(all, known);
    for (auto& each : all) {
        auto why = each.file.profile ? objection(each, together) : std::nullopt;
        if (!why) continue;
        refuse(each.file, std::move(*why));
        refused = Refused::some;
    }
    return refused;
}

Objection asks_for_no_adapter(basic::Streams streams) {
    return [=](Read const& read, std::vector<ComponentProfile> const& known) -> std::optional<std::string> {
        if (read.is_idle) return {};
        try {
            basic::adapter_of(*read.file.profile, known, streams);
            return {};
        } catch (std::runtime_error const& error) {
            return read.adapter_place + ": " + error.what();
        }
    };
}

Objection is_named_as_another(basic::Streams streams) {
    auto const files = std::make_shared<std::map<std::string, std::string>>();  // file names, by the names of their components
    return [=](Read const& read, std::vector<ComponentProfile> const& known) -> std::optional<std::string> {
        auto const& profile = *read.file.profile;
        if (read.is_idle || basic::adapter_of(profile, known, streams).empty()) return {};
        auto const name = basic::component_name(profile);
        auto const [first, is_first] = files->try_emplace(name, read.file.name);
        bool const is_basic = basic::is_basic(name);
        if (is_first && !is_basic) return {};
        return (name == profile.object.name ? read.name_place : read.identifier_place) + ": there is a component " +
               quoted(name, 200) + " already: it is " + (is_basic ? "the gateway's own" : "that of " + first->second);
    };
}

// Repeats the checks until no file includes a refused one.
void refuse_what_makes_nothing(std::vector<Read>& all, std::vector<ComponentProfile> const& known, basic::Streams streams) {
    auto const some = [&](Objection const& objection) { return refuse(all, known, objection) == Refused::some; };
    do {
        while (some(includes_unknown)) {
        }
    } while (some(includes_itself) || some(asks_for_no_adapter(streams)) || some(is_named_as_another(streams)));
}

void warn_of_ambiguous(std::vector<Read>& all, std::vector<ComponentProfile> const& known) {
    auto const together = with_known(all, known);
    for (auto& each : all) {
        if (!each.file.profile) continue;
        auto const& parts = each.file.profile->sub_components;
        for (std::size_t i = 0; i < parts.size(); ++i) {
            auto const meant = find_parts(together, *each.file.profile, parts[i]);
            if (meant.size() < 2) continue;
            warn(each.file, each.sub_component_places[i] + ": " + rois::quoted(parts[i]) + " may mean " +
                                quoted(meant[0]->object.identifier, 200) + " or " + quoted(meant[1]->object.identifier, 200) +
                                "; the gateway uses the first: write the whole identifier");
        }
    }
}

}  // namespace

std::vector<ProfileFile> read_profile_folder(std::shared_ptr<xml::Schemas const> const& schemas, std::string const& folder,
                                             std::vector<ComponentProfile> const& known, basic::Streams streams) {
    std::vector<Read> all;
    for (auto const& path : documents_in(folder)) all.push_back(read(schemas, path));
    refuse_doubles(all, known);
    refuse_what_makes_nothing(all, known, streams);
    warn_of_ambiguous(all, known);
    std::vector<ProfileFile> files;
    files.reserve(all.size());
    for (auto& each : all) files.push_back(std::move(each.file));
    return files;
}

std::string report_of(std::vector<ProfileFile> const& files) {
    std::string text;
    std::size_t counts[3] = {};
    for (auto const& file : files) {
        ++counts[static_cast<std::size_t>(file.verdict)];
        if (file.verdict == Verdict::ok) text += file.name + ": ok\n";
        for (auto const& finding : file.findings)
            text += (file.verdict == Verdict::refused ? "refused: " : "warning: ") + finding + "\n";
    }
    auto const number = [&](Verdict verdict) { return std::to_string(counts[static_cast<std::size_t>(verdict)]); };
    return text + std::to_string(files.size()) + " files: " + number(Verdict::ok) + " ok, " + number(Verdict::warning) +
           " with warnings, " + number(Verdict::refused) + " refused\n";
}

}  // namespace rois
