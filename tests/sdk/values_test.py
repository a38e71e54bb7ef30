"""Tests of how components/sdk/python/rois_component.py reads arguments and writes results."""
import unittest

from fake_engine import rois
from machines import TYPES, ModuleTest, until


class Values(ModuleTest):
    valid = {
        "flag": {"true": True, "false": False, " 1 ": True, "0": False},
        "moment": {"2024-02-29T23:59:59.123Z": "2024-02-29T23:59:59.123Z", "2026-01-01T00:00:00+14:00": "2026-01-01T00:00:00+14:00"},
        "day": {"2026-11-20": "2026-11-20", "2026-11-20Z": "2026-11-20Z"},
        "clock": {"12:00:00": "12:00:00", "23:59:59.5-09:30": "23:59:59.5-09:30"},
        "count": {"-5": -5, "+5": 5, "007": 7, "2147483647": 2147483647},
        "size": {"1e3": 1000.0, ".5": 0.5, "-1.": -1.0, "INF": float("inf"), "-INF": -float("inf")},
        "text": {" x ": " x ", "": ""},
        "counts": {"1 2  3": [1, 2, 3], "": []},
    }
    invalid = {
        "flag": ["no value", "", "True", "yes", "2"],
        "moment": ["no value", "2026-01-01", "2026-01-01T00:00:00", "2026-13-01T00:00:00Z", "2026-02-29T00:00:00Z", "2026-01-01T24:00:00Z"],
        "day": ["no value", "2026-02-30", "2026-1-1", "20260101", "2026-01-01T00:00:00Z"],
        "clock": ["no value", "24:00:00", "12:00", "12:60:00", "12:00:00+15:00"],
        "count": ["no value", "", "1.5", "1_000", "0x10", "\u0661", "2147483648", "+-1", "1 2"],
        "size": ["no value", "", "nan", "inf", "1_0", "1e", "1e999", "0x1p3", "infinity"],
        "counts": ["1 x", "1,2", "1.5"],
    }

    async def test_valid_values_of_each_type_are_read(self):
        await self.link.connect()
        for name, texts in self.valid.items():
            for text, value in texts.items():
                self.assert_ok(await self.link.execute("a", "take", **{name: (TYPES[name], text)}))
                await until(lambda: self.a.taken)
                self.assertEqual(repr(self.a.taken.pop()[name]), repr(value), text)

    async def test_invalid_values_of_each_type_are_refused(self):
        await self.link.connect()
        for name, texts in self.invalid.items():
            for text in texts:
                answer = await self.link.execute("a", "take", check_only=True, **{name: (TYPES[name], text)})
                self.assertEqual(answer.get("return_code"), "BAD_PARAMETER", f"{name}: {text!r}")
                self.assertIn(TYPES[name], answer.findtext(rois.M + "reason"))

    async def test_other_names_of_types_have_their_ranges(self):
        for code, lowest, highest in (("xsd:byte", -128, 127), ("unsignedInt", 0, 2**32 - 1), ("urn:x-rois:def:DataType:ATR::Integer", -(2**31), 2**31 - 1)):
            for number in (lowest, highest):
                self.assertEqual(rois.read_value("x", code, [str(number)]), number)
            for number in (lowest - 1, highest + 1):
                self.assertRaises(rois.Refused, rois.read_value, "x", code, [str(number)])
        self.assertEqual(rois.read_value("x", "Component_Status", ["READY"]), "READY")
        self.assertRaises(rois.Refused, rois.read_value, "x", "Component_Status", ["ready"])
        self.assertRaises(rois.Refused, rois.read_value, "x", "RoISIdentifier", [" "])
        self.assertEqual(rois.read_value("x", "Set<string>", ["a b", "c"]), ["a b", "c"])

    async def test_infinity_and_nan_are_written_as_in_xml_schema(self):
        values = [float("inf"), float("-inf"), float("nan"), 1e300]
        types = {"all": "double[]", "one": "double", "text": "string"}
        document = rois.results(types, {"all": values, "one": values[1], "text": "inf nan"})
        found = [each.text for each in rois.ElementTree.fromstring(f"<all {rois.NAMES}>{document}</all>").iter(rois.R + "value")]
        self.assertEqual(found, ["INF -INF NaN 1e+300", "-INF", "inf nan"])
        self.assertEqual(repr(rois.read_value("one", "double[]", found[:1])), repr(values))

    async def test_a_list_of_numbers_is_one_value(self):
        await self.link.connect()
        self.assertEqual([each.text for each in (await self.link.query("a", "numbers")).iter(rois.R + "value")], ["1 2 3"])


if __name__ == "__main__":
    unittest.main(warnings="ignore")
