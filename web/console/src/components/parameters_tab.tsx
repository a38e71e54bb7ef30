// The Parameters tab: a component's current parameters and a form to set them.
import { useState } from 'preact/hooks';
import { component_ref_xml, element, parameter_xml, request } from 'rois-client';

import { useConsole, useWatch } from '../context';
import { arguments_in, ArgumentFields, asked_by, Exchange, type Inputs, problems_in, ResultsTable, useDraft } from '../forms';
import type { ComponentView } from '../state/engine/profile_state';
import { Form } from '../ui';
import { written } from './commands_tab';
import * as texts from './texts';

export function ParametersTab({ view }: { view: ComponentView }) {
  const { parameters } = useConsole();
  useWatch(parameters.poll(view.ref));
  const current = parameters.of(view.ref);
  return (
    <>
      <h3>{texts.values_now()}</h3>
      {current && current.parameters.length > 0 ? (
        <ResultsTable label={texts.values_now()} results={current} />
      ) : (
        <p class="soft">{texts.no_values()}</p>
      )}
      {view.parameters.length > 0 ? <SetForm view={view} /> : <p class="soft">{texts.no_parameters()}</p>}
    </>
  );
}

function SetForm({ view }: { view: ComponentView }) {
  const console = useConsole();
  const [inputs, change] = useDraft<Inputs>(`${view.ref} set_parameter`, {});
  const [was_tried, set_tried] = useState(false);
  const asked = asked_by(view, 'set_parameter');
  const problems = problems_in(console, view.ref, asked, inputs);
  const given = arguments_in(console, view.ref, asked, inputs);
  const set = async () => {
    await console.set_parameter(view.ref, Object.fromEntries(given.map((one) => [one.name, one])));
    console.parameters.poll(view.ref).now();
  };
  return (
    <Form class="component-form">
      <h3>{texts.set_title()}</h3>
      <ArgumentFields view={view} asked={asked} inputs={inputs} change={change} problems={problems} />
      {was_tried && given.length === 0 && <p class="field-error" role="alert">{texts.set_nothing()}</p>}
      <Exchange
        by_enter
        title={`${view.ref} set_parameter`}
        operation="set_parameter"
        label={texts.set()}
        icon="check"
        request={written(() =>
          request('set_parameter', {}, component_ref_xml(view.ref) + element('parameters', {}, ...given.map((one) => parameter_xml(one)))),
        )}
        may_send={() => {
          set_tried(true);
          return Object.keys(problems).length === 0 && given.length > 0;
        }}
        act={set}
      />
    </Form>
  );
}
