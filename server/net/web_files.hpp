// The files of the web console: its page, and assets whose names change with their content.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "net/http_answer.hpp"
#include "net/http_head.hpp"
#include "xml/validation/schemas.hpp"

namespace rois::net {

// Immutable; any thread. The bytes must outlive it.
class WebFiles {
public:
    // By path, "index.html" and "assets/..."; what ends with ".gz" is the compressed form of the file of that name.
    explicit WebFiles(xml::NamedFiles const&);

    bool empty() const { return files_.empty(); }

    // A file, in the form that the client takes, or the fault not_found.
    HttpAnswer answer(std::string_view path, RequestHead const&) const;

private:
    struct File {
        std::string_view plain;
        std::string_view compressed;  // empty: there is no such form
        std::string digest;
    };
    std::map<std::string, File, std::less<>> files_;
};

}  // namespace rois::net
