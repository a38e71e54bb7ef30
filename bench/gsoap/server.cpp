// rois-gsoap PORT: the comparable call served by gSOAP with HTTP keep-alive, a thread for each connection, as its manual has it.
#include <cstdlib>
#include <thread>

#include "hall.nsmap"
#include "soapH.h"

int hall__query(soap* soap, char* query_type, char* component_ref, char* engine, double range, hall__Reading* reading) {
    bool const complete = query_type != nullptr && component_ref != nullptr && engine != nullptr && range > 0;
    reading->timestamp = soap_strdup(soap, "2026-11-21T09:55:58.848Z");
    reading->robot_ref = soap_strdup(soap, component_ref);
    reading->position_data = soap_strdup(soap, "9498.984, 7429.98, -145.611");
    reading->value = complete ? 1 : 0;
    return SOAP_OK;
}

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    soap* const listening = soap_new1(SOAP_IO_KEEPALIVE | SOAP_C_UTFSTRING);
    listening->max_keep_alive = 0;                           // no limit
    listening->recv_timeout = listening->send_timeout = 30;  // seconds, as the gateway has it
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
