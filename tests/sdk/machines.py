"""A program with two components whose functions a test replaces, and the engine that the test plays."""
import asyncio
import logging
import unittest

from fake_engine import Engine, patience, rois

TYPES = {"flag": "bool", "moment": "DateTime", "day": "Date", "clock": "Time", "count": "int", "size": "double", "text": "string", "counts": "int[]"}


def message(kind, name, parameters="", element="Arguments"):
    inner = "".join(f'<rois:{element} rois:name="{key}"><rois:data_type_ref rois:code="{code}"/></rois:{element}>' for key, code in parameters)
    return f'<rois:MessageProfile xsi:type="rois:{kind}MessageProfileType" rois:name="{name}">{inner}</rois:MessageProfile>'


class Machine(rois.Component):
    """A component whose functions the test replaces."""

    profile = (
        f'<rois:HRIComponentProfile xmlns:rois="{rois.R[1:-1]}" xmlns:gml="{rois.GML[1:-1]}" xmlns:xsi="{rois.XSI[1:-1]}" gml:id="profile.machine">'
        "<gml:identifier>urn:x-example:def:component:Machine</gml:identifier><gml:name>machine</gml:name>"
        "<rois:SubComponentProfile>urn:x-rois:def:component:OMG::RoISCommon</rois:SubComponentProfile>"
        + message("Command", "take", TYPES.items())
        + message("Command", "set_parameter", [("level", "int")])
        + message("Query", "state", [("is_on", "bool")], "Results")
        + message("Query", "numbers", [("all", "int[]")], "Results")
        + message("Event", "switched", [("number", "int")], "Results")
        + '<rois:ParameterProfile rois:name="level" rois:default_value="1"><rois:data_type_ref rois:code="int"/></rois:ParameterProfile>'
        "</rois:HRIComponentProfile>"
    )
    continuous = True

    def __init__(self, ref):
        super().__init__(ref)
        self.taken, self.halts, self.levels = [], 0, []

    async def take(self, arguments):
        self.taken.append(arguments)

    async def set_parameter(self, arguments):
        self.levels.append(arguments["level"])

    async def halt(self):
        self.halts += 1

    def state(self):
        return {"is_on": True}

    def numbers(self):
        return {"all": [1, 2, 3]}


def fail_with(problem):
    async def fail(*arguments):
        raise problem

    return fail


def wait_for(seconds):
    async def wait(*arguments):
        await asyncio.sleep(seconds)

    return wait


def halts_slowly(component):
    """Each halt takes 0.2 s. Returns the list of those that have ended."""
    halts = []

    async def slow():
        await asyncio.sleep(0.2)
        halts.append("halt")

    component.halt = slow
    return halts


async def until(condition):
    for _ in range(patience * 100):
        if condition():
            return
        await asyncio.sleep(0.01)
    raise AssertionError("the condition did not become true")


class ModuleTest(unittest.IsolatedAsyncioTestCase):
    async def asyncSetUp(self):
        logging.disable(logging.CRITICAL)
        self.engine = await Engine().open()
        self.a, self.b = Machine("a"), Machine("b")
        self.service = rois.Service("machines", [self.a, self.b])
        self.program = asyncio.ensure_future(rois.keep_joined(self.service, self.engine.url))
        self.link = await self.engine.link()

    async def asyncTearDown(self):
        self.a.halt = self.b.halt = wait_for(0)
        self.program.cancel()
        await asyncio.wait([self.program])
        self.engine.close()

    async def completed(self, id, status):
        return await self.link.report("completed", command_id=id, status=status)

    def assert_ok(self, answer):
        self.assertEqual(answer.get("return_code"), "OK", rois.ElementTree.tostring(answer))
