"""The documents that the load generator sends: requests of given sizes, and requests for the stage's probes."""

MESSAGE = "urn:x-rois:psm:xml:message:1"
ROIS = "http://www.omg.org/spec/RoIS/20240801"
FES = "http://www.opengis.net/fes/2.0"
XSI = "http://www.w3.org/2001/XMLSchema-instance"

PROBE = "urn:x-rois:def:component:bench::Probe"

SIZES = {"0.3": 300, "0.6": 600, "3": 3_000, "20": 20_000}  # kB -> bytes


def is_equal(reference, literal):
    return (
        f"<fes:PropertyIsEqualTo><fes:ValueReference>{reference}</fes:ValueReference>"
        f"<fes:Literal>{literal}</fes:Literal></fes:PropertyIsEqualTo>"
    )


def is_like(reference, pattern):
    return (
        f'<fes:PropertyIsLike wildCard="*" singleChar="?" escapeChar="!"><fes:ValueReference>{reference}</fes:ValueReference>'
        f"<fes:Literal>{pattern}</fes:Literal></fes:PropertyIsLike>"
    )


def condition(predicates, operator="Or"):
    if not predicates:
        return ""
    inside = predicates[0] if len(predicates) == 1 else f"<fes:{operator}>" + "".join(predicates) + f"</fes:{operator}>"
    return f"<condition><fes:Filter>{inside}</fes:Filter></condition>"


def query(query_type, predicates=()):
    fes = f' xmlns:fes="{FES}"' if predicates else ""
    return f'<query xmlns="{MESSAGE}"{fes}><query_type>{query_type}</query_type>{condition(predicates)}</query>'


def query_of_size(size, query_type="engine_status", component="system_information"):
    """A query of `size` bytes. Its condition names many components, of which the gateway has one."""

    def whole(names):
        return query(query_type, [is_equal("component_ref", name) for name in names])

    names = [component, "x"]
    while len(whole([*names, f"another_component_{len(names)}"])) <= size:
        names.append(f"another_component_{len(names)}")
    names[1] = "x" * (1 + size - len(whole(names)))
    return whole(names)


def smallest_query(size):
    """A query whose condition names one component, padded with spaces between elements."""
    text = query("engine_status", [is_equal("component_ref", "system_information")])
    return text.replace("><", ">" + " " * (size - len(text)) + "<", 1) if len(text) < size else text


def parameter(element, name, code, value):
    return (
        f'<{element} rois:name="{name}"><rois:data_type_ref rois:code="{code}"/>'
        f"<rois:value>{value}</rois:value></{element}>"
    )


def unit(component, command_type, parameters=""):
    arguments = f"<rois:arguments>{parameters}</rois:arguments>" if parameters else ""
    return (
        f'<rois:command_unit_list xsi:type="rois:CommandMessageType" rois:command_type="{command_type}" rois:command_id="">'
        f'<rois:component_ref rois:code="{component}"/>{arguments}</rois:command_unit_list>'
    )


def execute(units):
    return (
        f'<execute xmlns="{MESSAGE}" xmlns:rois="{ROIS}" xmlns:xsi="{XSI}">'
        f'<rois:CommandUnitSequence>{"".join(units)}</rois:CommandUnitSequence></execute>'
    )


def execute_of_size(size):
    """A long sequence of commands, as an application sends it that plans ahead."""
    units = []
    while len(execute(units)) < size:
        text = f"Welcome, visitor number {len(units)}. Please take a seat until you are called."
        units.append(unit("speech_synthesis", "start", parameter("rois:parameter", "speech_text", "string", text)))
    return execute(units)


def subscribe(event_type, predicates=(), operator="Or"):
    return (
        f'<subscribe xmlns="{MESSAGE}" xmlns:fes="{FES}" inline_results="true">'
        f"<event_type>{event_type}</event_type>{condition(predicates, operator)}</subscribe>"
    )


def all_documents():
    """File name without .xml -> text."""
    rois = f'xmlns="{MESSAGE}" xmlns:rois="{ROIS}"'
    label = "in the garden, under the old tree by the wall"
    documents = {f"query-{name}kB": query_of_size(size) for name, size in SIZES.items() if size >= 600}
    documents["query-0.6kB-hall"] = query_of_size(SIZES["0.6"], component="hall.system_information")
    documents["query-0.3kB"] = smallest_query(SIZES["0.3"])
    documents["execute-20kB"] = execute_of_size(SIZES["20"])
    documents["reading"] = query("reading")
    documents["reading-by-ref"] = query("reading", [is_equal("component_ref", "probe7")])
    documents["status-by-type"] = query("component_status", [is_equal("component_type", PROBE)])
    documents["bind"] = f'<bind {rois}><component_ref rois:code="probe{{connection}}"/></bind>'
    documents["set_parameter"] = (
        f'<set_parameter {rois}><component_ref rois:code="probe{{connection}}"/>'
        f'<parameters>{parameter("parameter", "label", "string", label)}</parameters></set_parameter>'
    )
    documents["reading-0.6kB"] = query_of_size(SIZES["0.6"], "reading", "probe7")
    speak = unit("speech_synthesis", "start", parameter("rois:parameter", "speech_text", "string", "Good morning."))
    documents["bind-speech"] = f'<bind {rois}><component_ref rois:code="speech_synthesis"/></bind>'
    documents["execute-speech"] = execute([speak])
    documents["execute"] = execute([unit("probe{connection}", "start")])
    for burst in (1, 8, 100):
        documents[f"fire-{burst}"] = execute([unit("probe0", "fire", parameter("rois:parameter", "burst", "int", burst))])
    documents["bind-probe0"] = documents["bind"].replace("{connection}", "0")
    for name in ("bind-probe0", "fire-100"):
        documents[f"{name}-hall"] = documents[name].replace("probe0", "hall.probe0")
    for name, component in (("logical", "probe"), ("member", "robot0.probe")):
        documents[f"reading-0.6kB-{name}"] = query_of_size(SIZES["0.6"], "reading", component)
        documents[f"subscribe-{name}"] = subscribe("probed", [is_equal("component_ref", component)])
        for each in ("bind-probe0", "fire-100"):
            documents[f"{each.removesuffix('-probe0')}-{name}"] = documents[each].replace("probe0", component)
    documents["subscribe"] = subscribe("probed")
    documents["subscribe-conditioned"] = subscribe("probed", [is_equal("value", 42), is_equal("stamp", "nowhere")])
    documents["subscribe-elsewhere"] = subscribe("probed", [is_equal("value", "1{number}"), is_equal("stamp", "{number}")])
    another = [is_equal("component_ref", "probe1"), is_equal("value", "{number}")]
    documents["subscribe-another"] = subscribe("probed", another, "And")
    documents["call-of-xmlrpc"] = call_of_xmlrpc()
    documents["call-of-gsoap"] = call_of_gsoap()
    return documents


def write_all(folder):
    """Writes all documents as *.xml. The subfolder `micro` gets those for the gateway, as the first connection sends them."""
    (folder / "micro").mkdir(parents=True, exist_ok=True)
    for name, text in all_documents().items():
        (folder / f"{name}.xml").write_text(text)
        if not name.startswith("call-"):
            first = text.replace("{connection}", "0").replace("{number}", "0")
            (folder / "micro" / f"{name}.xml").write_text(first)


def call_of_xmlrpc():
    """A comparable call for xmlrpc_server.py, of 600 bytes."""
    return _padded(
        "<?xml version='1.0'?>\n<methodCall>\n<methodName>query</methodName>\n<params>\n"
        "<param>\n<value><string>engine_status</string></value>\n</param>\n"
        "<param>\n<value><string>system_information</string></value>\n</param>\n"
        "<param>\n<value><string>{}</string></value>\n</param>\n"
        "<param>\n<value><double>2.5</double></value>\n</param>\n</params>\n</methodCall>\n"
    )


def call_of_gsoap():
    """The query for rois-gsoap, of 600 bytes: the same type and condition, in gSOAP's envelope."""
    equal = "<PropertyIsEqualTo><ValueReference>component_ref</ValueReference><Literal>{}</Literal></PropertyIsEqualTo>"
    return _padded(
        '<?xml version="1.0" encoding="UTF-8"?>\n'
        '<SOAP-ENV:Envelope xmlns:SOAP-ENV="http://schemas.xmlsoap.org/soap/envelope/" xmlns:hall="urn:x-rois:bench:hall">'
        "<SOAP-ENV:Body><hall:query><query_type>engine_status</query_type><condition><Filter><Or>"
        f"{equal.format('system_information')}{equal}"
        "</Or></Filter></condition></hall:query></SOAP-ENV:Body></SOAP-ENV:Envelope>"
    )


def _padded(text):
    return text.format("x" * (SIZES["0.6"] - len(text) + 2))
