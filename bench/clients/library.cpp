// rois-library-client PORT DOCUMENT SECONDS [blocking]: one query after the other with the C++ client, in a coroutine or with
// Blocking.
#include <stdexcept>

#include "clients/round_trips.hpp"
#include "files/files.hpp"
#include "rois/blocking.hpp"
#include "xml/codec/codec.hpp"
#include "xml/validation/schemas.hpp"

namespace rois::bench {

namespace {

// The query of the document, as an application passes it.
Query query_of(std::string const& document) {
    xml::Platform const platform;
    xml::RequestReader reader{std::make_shared<xml::Schemas const>(files::schemas())};
    return std::get<Query>(std::get<Request>(reader.read(document)).operation);
}

void check(Query::Reply const& reply) {
    auto const* const status = find(reply.results.parameters, "status");
    if (status == nullptr || status->values.at(0) != "READY")
        throw std::runtime_error("the answer's result 'status' is not READY");
}

Task<> ask(Client& robot, Query query, RoundTrips& trips) {
    do {
        auto const reply = co_await robot.query(query.query_type, query.condition);
        check(reply);
    } while (trips.next());
}

void measure(Setting const& setting, RoundTrips& trips) {
    auto query = query_of(setting.document);
    Settings settings;
    settings.url = "http://127.0.0.1:" + std::to_string(setting.port);
    Blocking robot{settings};
    robot.open();
    if (!setting.blocking) return robot(ask(robot.client(), std::move(query), trips));
    do check(robot.query(query.query_type, query.condition));
    while (trips.next());
}

}  // namespace

}  // namespace rois::bench

int main(int argc, char** argv) { return rois::bench::measure_round_trips(argc, argv, rois::bench::measure); }
