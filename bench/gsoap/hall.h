// What soapcpp2 makes the gSOAP server of: one call with four parameters, as long as a query of the gateway.
//gsoap hall service name: hall
//gsoap hall service namespace: urn:x-rois:bench:hall
//gsoap hall service style: document
//gsoap hall service encoding: literal

struct hall__Reading {
    char* timestamp;
    char* robot_ref;
    char* position_data;
    int value;
};

int hall__query(char* query_type, char* component_ref, char* engine, double range, struct hall__Reading* reading);
