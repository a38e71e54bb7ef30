"""Lamps that break one rule each, for rois-component-test: `python3 broken_lamp.py VARIANT`."""
import asyncio
import os
import pathlib
import signal
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "components" / "sdk" / "python"))
import lamp  # noqa: E402
import rois_component as rois  # noqa: E402

Service, Lamp = rois.Service, lamp.Lamp
variant = sys.argv.pop(1)


def replace(owner, name):
    """Replaces a function by the decorated one, which receives the old one first."""
    old = getattr(owner, name)

    def decorate(new):
        setattr(owner, name, lambda *arguments, **named: new(old, *arguments, **named))

    return decorate


if variant == "answers_twice":

    @replace(Service, "answer")
    def answer(old, self, request, document):
        old(self, request, document)
        self.socket.send(document.encode())

elif variant == "answers_without_request_id":

    @replace(Service, "reply")
    def reply(old, self, name, request, *arguments, **named):
        request.attrib.pop("request_id", None)
        old(self, name, request, *arguments, **named)

elif variant == "completes_twice":

    @replace(Service, "completed")
    def completed(old, self, *arguments, **named):
        old(self, *arguments, **named)
        old(self, *arguments, **named)

elif variant == "never_completes":

    @replace(Service, "completed")
    def completed(old, self, component, id, status, values=None, command="", reason=""):
        if command != "start":
            old(self, component, id, status, values, command, reason)

elif variant == "does_not_halt":

    class Stubborn(Lamp):
        async def start(self, arguments):
            await asyncio.shield(asyncio.ensure_future(asyncio.sleep(5)))

        async def halt(self):
            await asyncio.sleep(2)

    lamp.Lamp = Stubborn

elif variant == "answers_with_a_wrong_type":

    @replace(Lamp, "light")
    def light(old, self):
        return {"is_on": "bright"}

elif variant == "answers_with_another_declared_type":

    @replace(rois, "results")
    def results(old, types, values):
        return old(types, values).replace('rois:code="bool"', 'rois:code="int"')

elif variant == "answers_without_a_result":

    @replace(Lamp, "light")
    def light(old, self):
        return {}

elif variant == "reports_a_wrong_event":

    @replace(Lamp, "switch")
    def switch(old, self, on):
        self.is_on = on
        self.event("switched", {"is_on": "perhaps"})

elif variant == "reports_without_a_subscription":

    @replace(Service, "event")
    def event(old, self, component, event_type, values):
        self.subscribed.setdefault(event_type, "all")
        old(self, component, event_type, values)

elif variant == "accepts_any_argument":

    @replace(Service, "arguments")
    def arguments(old, self, component, command, unit):
        return {"times": 1}

elif variant == "runs_what_is_only_checked":

    @replace(Service, "on_execute")
    async def on_execute(old, self, request):
        request.attrib.pop("check_only", None)
        await old(self, request)

elif variant == "has_no_instance":

    @replace(Service, "reply")
    def reply(old, self, name, request, code="OK", content="", reason="", attributes=""):
        old(self, name, request, code, content.replace(self.instance, "another"), reason, attributes)

elif variant == "joins_under_a_new_instance":

    @replace(rois, "join")
    async def join(old, service, url):
        service.instance = os.urandom(8).hex()
        await old(service, url)

elif variant == "forgets_what_it_has_sent":

    @replace(Service, "on_resume")
    async def on_resume(old, self, request):
        self.sent.clear()
        self.sequence += 1
        await old(self, request)

elif variant == "forgets_how_a_command_has_ended":

    @replace(rois, "with_status")
    def with_status(old, status, reason="", content="<results/>"):
        return content

elif variant == "drops_notifications_while_the_link_is_down":

    @replace(Service, "notify")
    def notify(old, self, *arguments, **named):
        if self.socket or not self.session:
            old(self, *arguments, **named)

elif variant == "drops_events_while_the_link_is_down":

    @replace(Service, "event")
    def event(old, self, *arguments, **named):
        if self.socket or not self.session:
            old(self, *arguments, **named)

elif variant == "forgets_its_subscriptions_with_the_link":

    @replace(Service, "serve")
    async def serve(old, self, socket):
        try:
            await old(self, socket)
        finally:
            self.subscribed = {}

elif variant == "halts_when_the_link_is_lost":

    @replace(Service, "serve")
    async def serve(old, self, socket):
        try:
            await old(self, socket)
        finally:
            for component in self.components.values():
                self.halt(component)

elif variant == "resumes_any_session":

    @replace(Service, "on_resume")
    async def on_resume(old, self, request):
        self.session = request.get("session")
        await old(self, request)

elif variant == "never_ends_its_session":

    @replace(Service, "watch")
    async def watch(old, self):
        await asyncio.sleep(1e9)

elif variant == "keeps_its_session_for_a_new_engine":

    @replace(Service, "on_connect")
    async def on_connect(old, self, request):
        self.is_attached = bool(self.session)
        await old(self, request)

elif variant == "sends_an_invalid_document":

    @replace(Service, "state")
    def state(old, self, component):
        self.notify("component_changed", f"<status>{component.status}</status>")

elif variant == "ignores_the_end":
    signal.signal(signal.SIGTERM, signal.SIG_IGN)

    @replace(rois, "keep_joined")
    async def keep_joined(old, service, url):
        asyncio.get_running_loop().remove_signal_handler(signal.SIGTERM)
        signal.signal(signal.SIGTERM, signal.SIG_IGN)
        await old(service, url)

elif variant == "keeps_its_session_after_disconnect":

    @replace(Service, "on_disconnect")
    async def on_disconnect(old, self, request):
        self.reply("disconnect", request)

elif variant == "goes_on_after_its_session":

    @replace(Service, "end_session")
    async def end_session(old, self):
        self.session = ""
        self.subscribed.clear()

elif variant == "goes_on_after_release":

    @replace(Service, "on_release")
    async def on_release(old, self, request):
        self.reply("release", request)

elif variant == "goes_on_after_stop":

    @replace(Lamp, "blink")
    async def blink(old, self, arguments):
        await asyncio.shield(asyncio.ensure_future(old(self, arguments)))

elif variant == "stays_on_after_stop":

    @replace(Lamp, "halt")
    async def halt(old, self):
        pass

elif variant == "reports_no_active_function":
    Lamp.continuous = False

elif variant == "switches_on_when_it_checks":

    @replace(Lamp, "check")
    def check(old, self, command, arguments):
        old(self, command, arguments)
        self.switch(True)

elif variant == "accepts_a_fraction":

    @replace(rois, "read_value")
    def read_value(old, what, code, texts, is_default=False):
        return int(float(texts[0])) if code == "int" else old(what, code, texts, is_default)

elif variant == "drops_requests_behind_a_query":
    queries = set()

    @replace(Service, "on_query")
    async def on_query(old, self, request):
        queries.add(request)
        await asyncio.sleep(0.3)
        queries.remove(request)
        await old(self, request)

    @replace(Service, "handle")
    async def handle(old, self, request):
        if not queries:
            await old(self, request)

elif variant == "reports_each_event_twice":

    @replace(Service, "notify")
    def notify(old, self, element, *arguments, **named):
        for _ in range(2 if element == "receive_event" else 1):
            old(self, element, *arguments, **named)

elif variant == "ignores_pings":

    @replace(rois.WebSocket, "send")
    def send(old, self, payload, opcode=1):
        if opcode != 10:
            old(self, payload, opcode)

elif variant == "moves":
    Lamp.moves = True  # breaks no rule

elif variant == "moves_without_signs_of_life":

    @replace(Service, "on_connect")
    async def on_connect(old, self, request):
        await old(self, request)
        Lamp.moves = False

    @replace(Service, "on_get_profile")
    async def on_get_profile(old, self, request):
        Lamp.moves = True
        await old(self, request)
        Lamp.moves = False

else:
    sys.exit(f"unknown variant {variant}")

if __name__ == "__main__":
    rois.run("ws://127.0.0.1:8080", "lamps", [lamp.Lamp("lamp")])
