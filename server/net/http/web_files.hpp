// The files of the web console: its page, and assets whose names change with their content.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "xml/validation/schemas.hpp"

namespace rois::net {

struct HttpAnswer;
struct RequestHead;

// Immutable; any thread. The bytes must outlive it.
class WebFiles {
public:
    // By path, "index.html" and "assets/...". A file whose name ends with ".gz" is the compressed form of another file.
    explicit WebFiles(xml::NamedFiles const&);

    bool empty() const { return files_.empty(); }

    // Answers with the file, compressed if the client accepts that, or with the fault not_found.
    HttpAnswer answer(std::string_view path, RequestHead const&) const;

private:
    struct File {
        std::string_view plain;
        std::string_view compressed;  // empty: there is none
        std::string digest;
    };
    std::map<std::string, File, std::less<>> files_;
};

}  // namespace rois::net
