// Input of soapcpp2 for the gSOAP server: the gateway's query with its condition, and its answer with results, in gSOAP's form.
//gsoap hall service name: hall
//gsoap hall service namespace: urn:x-rois:bench:hall
//gsoap hall service style: document
//gsoap hall service encoding: literal

struct hall__IsEqual {
    char* ValueReference 1;
    char* Literal 1;
};

struct hall__Or {
    int __size;
    struct hall__IsEqual* PropertyIsEqualTo 1:64;
};

struct hall__Filter {
    struct hall__Or* Or 1;
};

struct hall__Condition {
    struct hall__Filter* Filter 1;
};

struct hall__Identifier {
    @char* authority 0;
    @char* code 1;
    @char* codebook_USCOREref 0;
};

struct hall__Result {
    @char* name 1;
    struct hall__Identifier* data_USCOREtype_USCOREref 1;
    int __size;
    char** value 0;
};

struct hall__Results {
    int __size;
    struct hall__Result* result 0;
};

struct hall__queryResponse {
    char* return_USCOREcode 1;
    struct hall__Identifier* component_USCOREref 0;
    struct hall__Results* results 0;
};

int hall__query(char* query_USCOREtype 1, struct hall__Condition* condition 0, struct hall__queryResponse& response);
