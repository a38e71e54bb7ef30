"""Tests of components/sdk/python/rois_component.py with an engine that the test plays."""
import asyncio
import pathlib
import signal
import subprocess
import sys
import time
import unittest
import unittest.mock

from fake_engine import patience, rois
from machines import Machine, ModuleTest, fail_with, halts_slowly, until, wait_for


class Failures(ModuleTest):
    async def test_an_exception_in_check_answers_with_error_and_its_text(self):
        await self.link.connect()

        def check(command, arguments):
            raise KeyError("oops")

        self.a.check = check
        answer = await self.link.execute("a", "take")
        self.assertEqual(answer.get("return_code"), "ERROR")
        self.assertIn("oops", answer.findtext(rois.M + "reason"))
        self.assert_ok(await self.link.execute("b", "take"))

    async def test_check_cannot_refuse_a_stop(self):
        await self.link.connect()

        def check(command, arguments):
            raise rois.Refused("never")

        self.a.check = check
        self.assert_ok(await self.link.execute("a", "stop"))
        await self.completed("stop", "OK")

    async def test_an_exception_in_halt_is_reported_once_and_ends_each_stop_with_error(self):
        await self.link.connect()
        self.a.halt = fail_with(RuntimeError("motor"))
        for id in "first", "second":
            self.assert_ok(await self.link.execute("a", "stop", id=id))
            end = await self.completed(id, "ERROR")
            self.assertIn("motor", end.findtext(rois.M + "reason"))
        error = await self.link.report("receive_error", error_type="COMPONENT_INTERNAL_ERROR")
        self.assertIn("motor", error.findtext(rois.M + "text"))
        self.assertEqual([each.tag for each in self.link.reports].count(rois.M + "receive_error"), 1)

    async def test_components_of_one_type_have_profiles_of_their_own(self):
        await self.link.connect()
        profile = await self.link.ask("get_profile")
        ids = [each.get(rois.GML + "id") for each in profile.iter(rois.R + "HRIComponentProfile")]
        self.assertEqual(ids, ["profile.a", "profile.b"])

    async def test_an_oserror_of_a_component_does_not_end_the_link(self):
        session = await self.link.connect()
        self.a.start = self.a.halt = self.a.take = fail_with(ConnectionResetError("serial port"))
        self.a.check = lambda command, arguments: open("/missing/file") if command == "take" else None
        self.a.state = lambda: open("/missing/file")
        self.assert_ok(await self.link.execute("a", "start"))
        await self.completed("start", "ERROR")
        self.assert_ok(await self.link.execute("a", "stop"))
        await self.completed("stop", "ERROR")
        self.assertEqual((await self.link.execute("a", "take")).get("return_code"), "ERROR")
        self.assertEqual((await self.link.query("a", "state")).get("return_code"), "ERROR")
        self.assertEqual(await self.link.connect(), session)

    async def test_all_components_are_halted_when_the_halt_of_one_fails_or_hangs(self):
        await self.link.connect()
        for ref in "ab":
            await self.link.execute(ref, "start")
        self.a.halt = fail_with(OSError("motor"))
        self.link.cut()
        await until(lambda: self.b.halts == 1)
        self.link = await self.engine.link()
        await self.link.connect()
        self.a.halt = wait_for(1)
        for ref in "ab":
            await self.link.execute(ref, "start")
        self.link.cut()
        await until(lambda: self.b.halts == 2)

    async def test_missing_signs_of_life_halt_the_others_when_one_halt_fails(self):
        self.a.moves = self.b.moves = True
        await self.link.connect(window=3_000, lease=100)
        for ref in "ab":
            await self.link.execute(ref, "start")
        self.a.halt = fail_with(OSError("motor"))
        await until(lambda: self.b.halts == 1)
        self.assertFalse(self.program.done())

    async def test_a_cancelled_halt_is_an_error(self):
        await self.link.connect()
        self.a.halt = fail_with(asyncio.CancelledError())
        await self.link.execute("a", "stop")
        await self.completed("stop", "ERROR")

    async def test_texts_with_control_characters_are_sent_as_valid_xml(self):
        await self.link.connect()
        self.a.take = fail_with(RuntimeError("\x1b[31m"))
        await self.link.execute("a", "take")
        await self.completed("take", "ERROR")

    async def test_an_exception_of_the_module_ends_the_program_with_an_exit_code(self):
        program = (
            "import sys; sys.path[:0] = sys.argv.pop().split(':'); import machines, fake_engine; rois = fake_engine.rois\n"
            "async def watch(self): raise RuntimeError('a mistake in the module')\n"
            "rois.Service.watch = watch\n"
            "rois.run('ws://127.0.0.1:9', 'machines', [machines.Machine('a')])"
        )
        here = str(pathlib.Path(__file__).resolve().parent)
        ended = subprocess.run([sys.executable, "-B", "-c", program, here], capture_output=True, timeout=patience)
        self.assertEqual(ended.returncode, 1, ended.stderr)

    async def test_sigterm_ends_a_program_whose_query_hangs(self):
        program = (
            "import sys; sys.path[:0] = sys.argv.pop().split(':'); import machines, fake_engine, time\n"
            "machines.Machine.state = lambda self: time.sleep(60)\n"
            f"fake_engine.rois.run('{self.engine.url}', 'machines', [machines.Machine('a')])"
        )
        here = str(pathlib.Path(__file__).resolve().parent)
        process = subprocess.Popen([sys.executable, "-B", "-c", program, here], stderr=subprocess.DEVNULL)
        link = await self.engine.link()
        await link.connect()
        link.query("a", "state")
        await asyncio.sleep(0.1)
        process.send_signal(signal.SIGTERM)
        self.assertEqual(await asyncio.get_running_loop().run_in_executor(None, process.wait, patience), 0)


class Waiting(ModuleTest):
    async def test_a_slow_query_delays_neither_pongs_nor_a_stop(self):
        await self.link.connect()
        self.a.state = lambda: time.sleep(0.6) or {"is_on": True}
        began = time.monotonic()
        answer = self.link.query("a", "state")
        self.link.send(b"", 9)
        self.link.execute("b", "stop")
        await self.completed("stop", "OK")
        await until(lambda: self.link.pongs == 1)
        self.assertLess(time.monotonic() - began, 0.5)
        self.assert_ok(await answer)

    async def test_a_query_may_be_a_coroutine(self):
        await self.link.connect()

        async def state():
            await asyncio.sleep(0.01)
            return {"is_on": False}

        self.a.state = state
        self.assertEqual(next((await self.link.query("a", "state")).iter(rois.R + "value")).text, "false")

    async def test_a_slow_query_delays_no_other_answer(self):
        await self.link.connect()
        self.link.answered.clear()
        self.a.state = lambda: time.sleep(0.2) or {"is_on": True}
        await asyncio.gather(self.link.query("a", "state"), self.link.query("b", "state"), self.link.execute("b", "take"))
        self.assertEqual(self.link.answered[-1], min(self.link.answered, key=int))
        self.assertEqual(len(self.b.taken), 1)

    async def test_a_query_that_hangs_is_answered_with_error(self):
        await self.link.connect()
        self.addCleanup(setattr, rois, "LONGEST_QUERY", rois.LONGEST_QUERY)
        rois.LONGEST_QUERY = 0.1
        self.a.state = lambda: time.sleep(1)
        self.assertEqual((await self.link.query("a", "state")).get("return_code"), "ERROR")

    async def test_halts_of_several_components_run_at_once(self):
        await self.link.connect()
        self.a.halt = self.b.halt = wait_for(0.3)
        began = time.monotonic()
        for ref in "ab":
            self.link.execute(ref, "stop", id=ref)
        for ref in "ab":
            await self.completed(ref, "OK")
        self.assertLess(time.monotonic() - began, 0.5)

    async def test_a_disconnect_waits_for_halts_at_most_half_a_second(self):
        await self.link.connect()
        for ref in "ab":
            await self.link.execute(ref, "start")
        self.a.halt, self.b.halt = wait_for(0.1), wait_for(1)
        began = time.monotonic()
        self.assert_ok(await self.link.ask("disconnect"))
        self.assertLess(time.monotonic() - began, 0.9)

    async def test_a_command_begins_after_the_halt_before_it(self):
        await self.link.connect()
        order = []

        async def halt():
            await asyncio.sleep(0.1)
            order.append("halt")

        async def start(arguments):
            order.append("start")

        self.a.halt, self.a.start = halt, start
        self.link.execute("a", "stop")
        self.link.execute("a", "start")
        await self.completed("start", "OK")
        self.assertEqual(order, ["halt", "start"])

    async def test_one_halt_is_enough_for_a_stop_its_repetition_and_the_release(self):
        await self.link.connect()
        await self.link.execute("a", "start")
        halts = halts_slowly(self.a)
        self.link.execute("a", "stop", id="first")
        await asyncio.sleep(0.05)
        self.link.execute("a", "stop", id="again")
        self.assert_ok(await self.link.release("a"))
        for id in ("first", "again"):
            await self.completed(id, "OK")
        self.assertEqual(halts, ["halt"])
        self.assert_ok(await self.link.release("a"))
        self.assertEqual(halts, ["halt"], "it stands still")

    async def test_a_stop_ends_a_start_that_waits_for_the_halt_before_it(self):
        await self.link.connect()
        halts = halts_slowly(self.a)
        self.link.execute("a", "stop", id="first")
        self.link.execute("a", "start")
        self.link.execute("a", "stop", id="second")
        await self.completed("start", "ABORT")
        await self.completed("second", "OK")
        self.assertEqual(halts, ["halt", "halt"])

    async def test_a_start_and_a_stop_in_one_packet_both_complete(self):
        await self.link.connect()
        self.a.start = wait_for(patience)
        self.link.execute("a", "start")
        self.link.execute("a", "stop")
        await self.completed("stop", "OK")
        await self.completed("start", "ABORT")


class Sessions(ModuleTest):
    async def test_connect_after_disconnect_opens_a_new_session_on_the_same_link(self):
        first = await self.link.connect()
        self.assert_ok(await self.link.ask("disconnect"))
        self.link.reports.clear()
        second = await self.link.connect()
        self.assertNotIn(second, (None, "", first))
        await self.link.report("component_changed")
        await self.link.execute("a", "take")
        await self.completed("take", "OK")

    async def test_a_closed_link_ends_the_session_one_window_later(self):
        await self.link.connect(window=300)
        await self.link.execute("a", "start")
        self.link.cut()
        cut = time.monotonic()
        await until(lambda: self.a.halts == 1)
        self.assertGreater(time.monotonic() - cut, 0.25)
        self.assertLess(time.monotonic() - cut, 1)
        self.assertEqual(self.service.session, "")

    async def test_a_silent_link_ends_two_seconds_and_one_window_after_the_last_byte(self):
        await self.link.connect(window=300)
        await self.link.execute("a", "start")
        self.service.socket.last_received -= 2
        await asyncio.sleep(0.15)
        self.assertEqual(self.a.halts, 0)
        await until(lambda: self.a.halts == 1)
        await self.engine.link()  # the program joins again

    async def test_a_link_that_returns_within_the_window_brings_what_was_reported(self):
        session = await self.link.connect(window=1_000)
        await self.link.subscribe("switched")
        self.link.cut()
        await until(lambda: self.service.socket is None)
        for number in (1, 2):
            self.a.event("switched", {"number": number})
        self.link = await self.engine.link()
        await until(lambda: self.service.socket)
        self.a.event("switched", {"number": 3})  # before resume: it must not overtake the others
        self.assert_ok(await self.link.ask("resume", attributes=f'session="{session}" last_sequence="2"'))
        await until(lambda: self.link.values("switched") == ["1", "2", "3"])


class Parameters(ModuleTest):
    async def test_release_restores_the_defaults(self):
        await self.link.connect()
        self.assertEqual(self.a.parameters, {"level": 1})
        await self.link.execute("a", "set_parameter", level=("int", "7"))
        await self.completed("set_parameter", "OK")
        self.assertEqual(self.a.parameters, {"level": 7})
        self.assert_ok(await self.link.release("a"))
        self.assertEqual(self.a.parameters, {"level": 1})
        self.assertEqual(self.a.levels, [7, 1])
        self.assert_ok(await self.link.release("a"))
        self.assertEqual(self.a.levels, [7, 1])

    async def test_the_end_of_the_session_restores_the_defaults(self):
        await self.link.connect()
        await self.link.execute("a", "start", level=("int", "5"))
        await self.completed("start", "OK")
        self.assertEqual(self.a.parameters, {"level": 5})
        self.link.cut()
        await until(lambda: self.a.parameters == {"level": 1})

    async def test_a_set_parameter_that_fails_changes_nothing(self):
        await self.link.connect()
        self.a.set_parameter = fail_with(OSError("motor"))
        await self.link.execute("a", "set_parameter", level=("int", "7"))
        await self.completed("set_parameter", "ERROR")
        self.assertEqual(self.a.parameters, {"level": 1})


class Tokens(unittest.TestCase):
    def test_are_sent_without_tls_to_this_machine_only(self):
        for url in ("ws://localhost:8080", "ws://127.0.0.1:8080", "ws://127.1.2.3", "ws://[::1]:8080", "wss://robot.example"):
            self.assertTrue(rois.is_safe(url), url)
        for url in ("ws://127.0.0.1.example", "ws://127.robot.example", "ws://localhost.example", "ws://10.0.0.1", "ws://[::2]", "ws://"):
            self.assertFalse(rois.is_safe(url), url)


class Memory(ModuleTest):
    """An engine cannot make a program grow without limit."""

    async def asyncSetUp(self):
        self.enterContext(unittest.mock.patch.object(rois, "MOST_BYTES", 100_000))
        await super().asyncSetUp()
        await self.link.connect()

    async def test_a_message_without_an_end_ends_the_link(self):
        self.link.send(b"<", is_end=False)
        for _ in range(3):
            self.link.send(b"x" * 60_000, opcode=0, is_end=False)
        await self.engine.link()

    async def test_an_engine_that_asks_and_does_not_read_loses_the_link(self):
        self.link.reading.cancel()
        while self.service.socket:
            for _ in range(1_000):
                self.link.send(b"x" * 125, opcode=9)
            await asyncio.sleep(0)
        await self.engine.link()


class Unsent(ModuleTest):
    async def restart(self):
        """The next link, to an engine that opens a new session."""
        self.link = await self.engine.link()
        await self.link.connect()

    async def report_two_events_and_cut_between(self):
        await self.link.connect(window=patience * 1_000)
        await self.link.subscribe("switched")
        self.a.event("switched", {"number": 1})
        await until(lambda: self.link.values("switched") == ["1"])
        self.link.cut()
        await until(lambda: self.service.socket is None)
        self.a.event("switched", {"number": 2})

    async def test_events_of_the_time_without_a_link_reach_a_restarted_engine(self):
        await self.report_two_events_and_cut_between()
        await self.restart()
        self.a.event("switched", {"number": 3})
        await self.link.subscribe("switched")
        self.a.event("switched", {"number": 4})
        await until(lambda: self.link.values("switched") == ["2", "3", "4"])
        self.assertEqual({each.findtext(rois.M + "subscribe_id") for each in self.link.reports[2:]}, {self.service.subscribed["switched"]})

    async def test_a_restarted_engine_that_first_asks_about_its_commands_misses_no_event(self):
        await self.report_two_events_and_cut_between()
        self.link = await self.engine.link()
        await self.link.ask("resume", attributes=f'session="{self.service.session}" last_sequence="0"')
        await self.link.ask("disconnect")
        self.link.reports.clear()
        await self.link.connect()
        await self.link.subscribe("switched")
        self.assertEqual(self.link.values("switched"), ["2"])

    async def test_events_after_the_end_of_the_session_wait_for_a_subscription(self):
        await self.link.connect(window=0)
        await self.link.subscribe("switched")
        self.link.cut()
        await until(lambda: not self.service.session)
        self.a.event("switched", {"number": 1})
        await self.restart()
        await self.link.subscribe("other")
        self.assertEqual(self.link.values("switched"), [])
        await self.link.subscribe("switched")
        self.assertEqual(self.link.values("switched"), ["1"])

    async def test_events_that_have_expired_are_dropped(self):
        self.a.event("switched", {"number": 1})
        end, *event = self.service.kept.pop()
        self.service.kept.append((end - 60, *event))
        await self.link.connect()
        await self.link.subscribe("switched")
        self.assertEqual(self.link.values("switched"), [])

    async def test_a_command_of_an_ended_session_does_not_complete_in_the_next_one(self):
        await self.link.connect()
        self.a.start = wait_for(patience)
        await self.link.execute("a", "start", id="old")
        self.link.cut()
        await self.restart()
        self.assert_ok(await self.link.execute("a", "stop"))
        await self.completed("stop", "OK")
        self.assertEqual([each.findtext(rois.M + "command_id") for each in self.link.reports if each.tag == rois.M + "completed"], ["stop"])
        known = await self.link.ask("get_command_result", "<command_id>old</command_id>")
        self.assertEqual(known.get("return_code"), "BAD_PARAMETER")

    async def result_of(self, id):
        answer = await self.link.ask("get_command_result", f"<command_id>{id}</command_id>")
        self.assert_ok(answer)
        return [(each.get(rois.R + "name"), each.findtext(rois.R + "value")) for each in answer.iter(rois.M + "result")]

    async def test_the_result_of_a_command_says_how_it_has_ended(self):
        await self.link.connect()
        self.a.take = fail_with(ValueError("too <heavy>"))
        await self.link.execute("a", "take", id="failed")
        await self.completed("failed", "ERROR")
        self.assertEqual(await self.result_of("failed"), [("status", "ERROR"), ("reason", "ValueError: too <heavy>")])
        self.a.start = wait_for(patience)
        await self.link.execute("a", "start", id="old")
        self.assertEqual(await self.result_of("old"), [("status", "RUNNING")])
        await self.link.execute("a", "stop", id="stop")
        await self.completed("stop", "OK")
        self.assertEqual(await self.result_of("old"), [("status", "ABORT"), ("reason", "it was stopped")])
        self.assertEqual(await self.result_of("stop"), [("status", "OK")])

    async def test_only_the_last_thousand_commands_are_known(self):
        await self.link.connect()
        for number in range(1_001):
            await self.link.execute("a", "take", id=f"c{number}")
        known = await self.link.ask("get_command_result", "<command_id>c0</command_id>")
        self.assertEqual(known.get("return_code"), "BAD_PARAMETER")
        await self.completed("c1000", "OK")
        self.assertEqual(await self.result_of("c1"), [("status", "OK")])

    async def test_a_query_may_report_events_from_its_thread(self):
        await self.link.connect()
        await self.link.subscribe("switched")
        self.a.state = lambda: self.a.event("switched", {"number": 1}) or {"is_on": True}
        self.assert_ok(await self.link.query("a", "state"))
        await until(lambda: self.link.values("switched") == ["1"])


if __name__ == "__main__":
    unittest.main(warnings="ignore")
