"""A lamp: a component program to begin with. Start it with `python3 lamp.py --url ws://127.0.0.1:8080 --name lamps`."""
import asyncio

import rois_component as rois


class Lamp(rois.Component):
    profile = """
<rois:HRIComponentProfile xmlns:rois="http://www.omg.org/spec/RoIS/20240801" xmlns:gml="http://www.opengis.net/gml/3.2"
    xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" gml:id="profile.lamp">
  <gml:identifier codeSpace="urn:ietf:rfc:2141">urn:x-example:def:component:Lamp</gml:identifier><gml:name>lamp</gml:name>
  <rois:SubComponentProfile>urn:x-rois:def:component:OMG::RoISCommon</rois:SubComponentProfile>
  <rois:MessageProfile xsi:type="rois:CommandMessageProfileType" rois:name="blink">
    <rois:Arguments rois:name="times"><rois:data_type_ref rois:code="int"/></rois:Arguments>
  </rois:MessageProfile>
  <rois:MessageProfile xsi:type="rois:QueryMessageProfileType" rois:name="light">
    <rois:Results rois:name="is_on"><rois:data_type_ref rois:code="bool"/></rois:Results>
  </rois:MessageProfile>
  <rois:MessageProfile xsi:type="rois:EventMessageProfileType" rois:name="switched">
    <rois:Results rois:name="is_on"><rois:data_type_ref rois:code="bool"/></rois:Results>
  </rois:MessageProfile>
</rois:HRIComponentProfile>"""
    continuous = True  # after `start`, the lamp is on until it is stopped
    is_on = False

    def check(self, command, arguments):
        if command == "blink" and not 1 <= arguments.get("times", 0) <= 100:
            raise rois.Refused(f"times must be a number from 1 to 100, not {arguments.get('times', 0)}")

    async def start(self, arguments):
        self.switch(True)

    async def halt(self):
        self.switch(False)

    async def blink(self, arguments):
        for _ in range(2 * arguments["times"]):
            self.switch(not self.is_on)
            await asyncio.sleep(0.2)

    def light(self):
        return {"is_on": self.is_on}

    def switch(self, on):
        self.is_on = on
        self.event("switched", {"is_on": on})


if __name__ == "__main__":
    rois.run("ws://127.0.0.1:8080", "lamps", [Lamp("lamp")])
