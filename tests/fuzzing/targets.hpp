// What the fuzzers feed: each target takes any bytes, as a hostile peer or a broken disk may produce them. It must not crash,
// hang or break a promise: then it throws std::logic_error, or a sanitizer ends the process.
#pragma once

#include <span>
#include <string_view>

namespace rois::fuzzing {

struct Target {
    std::string_view name;
    void (*run)(std::string_view input);
};

// Ordered by name.
std::span<Target const> targets();

// documents.cpp: request documents, conditions, answers to our clients, component profiles, grammars and spoken texts.
void messages(std::string_view);
void conditions(std::string_view);
void answers(std::string_view);
void profiles(std::string_view);
void speech(std::string_view);

// network.cpp: the requests of one HTTP connection, and the frames of one WebSocket.
void http(std::string_view);
void websocket(std::string_view);

// files.cpp: the files of the configuration, sub engines and tokens.
void configuration(std::string_view);
void engines(std::string_view);
void tokens(std::string_view);

// journal.cpp: the file of a journal, and its records.
void journals(std::string_view);
void records(std::string_view);

// roles.cpp: operations of an operator who may command one of two robots, and of an observer, in any order.
void roles(std::string_view);

}  // namespace rois::fuzzing
