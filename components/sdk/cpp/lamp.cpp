// A lamp: a component program to begin with. Start it with `rois-lamp --url ws://127.0.0.1:8080 --name lamps`.
#include "sdk/cpp/component_program.hpp"
#include "types/text/texts.hpp"

constexpr auto profile = R"(<rois:HRIComponentProfile xmlns:rois="http://www.omg.org/spec/RoIS/20240801"
    xmlns:gml="http://www.opengis.net/gml/3.2" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" gml:id="profile.lamp">
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
</rois:HRIComponentProfile>)";

class Lamp final : public rois::LocalComponent {
    rois::ComponentDescription const& description() const override { return description_; }
    rois::ComponentStatus status() const override { return rois::ComponentStatus::ready; }
    rois::Prepared prepare(std::string_view command, rois::ParameterList const& arguments) override {
        auto const* given = rois::find(arguments, "times");
        auto const text = given == nullptr ? "0" : given->values.front();
        auto const times = rois::to_double(text).value_or(0);
        if (command == "blink" && (times < 1 || times > 100))
            return rois::Refused{"times must be a number from 1 to 100, not " + text};
        bool const lights = command == "start";
        return [=, this](rois::CommandHandle id, rois::Instant) {
            for (int i = 0; i < 2 * times; ++i) light(!is_on_);
            if (lights) light(true);
            port().completed(id, rois::CompletedStatus::ok, {}, lights ? rois::Afterwards::active : rois::Afterwards::as_before);
        };
    }
    rois::Halted halt(rois::Instant) override { return light(false), rois::Halted::confirmed; }
    void suspend(rois::Instant) override { light(false); }
    void resume(rois::Instant) override { light(true); }
    std::vector<rois::Results> query(std::string_view, rois::Instant) override {
        return {{{rois::boolean("is_on", is_on_)}, {}}};
    }
    void light(bool on) {
        if (is_on_ != on) port().event("switched", {{rois::boolean("is_on", on)}, {}});
        is_on_ = on;
    }
    rois::ComponentDescription description_ = rois::sdk::describe("lamp", profile);
    bool is_on_ = false;
};

int main(int argc, char** argv) { return rois::sdk::serve<Lamp>(argc, argv, "lamps"); }
