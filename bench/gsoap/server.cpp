// rois-gsoap PORT: the same query served by gSOAP with its strictest checks, HTTP keep-alive and one thread for each connection,
// as in its manual.
#include <algorithm>
#include <cstring>
#include <thread>

#include "hall.nsmap"
#include "soapH.h"

namespace {

char const component[] = "system_information";

bool lets_through(hall__Condition const* condition) {
    if (condition == nullptr) return true;
    auto const& any = *condition->Filter->Or;
    return std::any_of(any.PropertyIsEqualTo, any.PropertyIsEqualTo + any.__size, [](hall__IsEqual const& equal) {
        return std::strcmp(equal.ValueReference, "component_ref") == 0 && std::strcmp(equal.Literal, component) == 0;
    });
}

template <class T>
T* made(soap* soap, int count = 1) {
    return static_cast<T*>(soap_malloc(soap, sizeof(T) * count));
}

hall__Identifier* identifier(soap* soap, char const* code, char const* authority = nullptr, char const* codebook = nullptr) {
    auto* const made_here = made<hall__Identifier>(soap);
    made_here->code = soap_strdup(soap, code);
    made_here->authority = soap_strdup(soap, authority);
    made_here->codebook_USCOREref = soap_strdup(soap, codebook);
    return made_here;
}

hall__Result result(soap* soap, char const* name, char const* type, char const* value) {
    hall__Result made_here;
    made_here.name = soap_strdup(soap, name);
    made_here.data_USCOREtype_USCOREref = identifier(soap, type);
    made_here.__size = 1;
    made_here.value = made<char*>(soap);
    made_here.value[0] = soap_strdup(soap, value);
    return made_here;
}

}  // namespace

int hall__query(soap* soap, char* query_type, hall__Condition* condition, hall__queryResponse& response) {
    bool const answered = std::strcmp(query_type, "engine_status") == 0 && lets_through(condition);
    response.return_USCOREcode = soap_strdup(soap, answered ? "OK" : "ERROR");
    if (!answered) return SOAP_OK;
    response.component_USCOREref =
        identifier(soap, component, "urn:ietf:rfc:2141", "urn:x-rois:def:component:OMG::SystemInformation");
    response.results = made<hall__Results>(soap);
    response.results->__size = 2;
    response.results->result = made<hall__Result>(soap, 2);
    response.results->result[0] = result(soap, "status", "Component_Status", "READY");
    response.results->result[1] = result(soap, "operable_time", "DateTime", "2026-11-21T09:55:58.848Z");
    return SOAP_OK;
}

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    soap* const listening = soap_new1(SOAP_IO_KEEPALIVE | SOAP_C_UTFSTRING | SOAP_XML_STRICT);
    listening->max_keep_alive = 0;                           // no limit
    listening->recv_timeout = listening->send_timeout = 30;  // seconds, as in the gateway
    listening->bind_flags = SO_REUSEADDR;
    if (!soap_valid_socket(soap_bind(listening, "127.0.0.1", std::atoi(argv[1]), 4096))) {
        soap_print_fault(listening, stderr);
        return 1;
    }
    while (soap_valid_socket(soap_accept(listening))) {
        std::thread([connection = soap_copy(listening)] {
            soap_serve(connection);
            soap_destroy(connection);
            soap_end(connection);
            soap_free(connection);
        }).detach();
    }
    return 1;
}
