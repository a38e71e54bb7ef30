// Forms from profiles: types, descriptions, validation and arguments.
import { type ParameterProfile, Results, value } from 'rois-client';
import { describe, expect, test } from 'vitest';

import { with_name } from '../../src/forms/codebooks';
import { data_type, type Kind, problem_of } from '../../src/forms/data_type';
import { type Asked, asked_by, choices_of, command_types, fixed_length, is_position, need_of, shown_description, units_of } from '../../src/forms/describe';
import { inputs_of, parameters_from, problems_of, with_input } from '../../src/forms/inputs';
import { options_for, type World as Things } from '../../src/forms/options';
import { views_of } from '../../src/state/engine/profile_state';
import { profile_xml, World } from './world';

function asked(name: string, type: string, more: Partial<Asked> = {}): Asked {
  return { name, data_type_ref: { code: type }, need: { kind: 'optional' }, ...more };
}

describe('types', () => {
  test.each<[string, Kind, boolean]>([
    ['int', 'integer', false],
    ['xsd:Int', 'integer', false],
    ['urn:x-rois:def:DataType:ATR::Integer', 'integer', false],
    ['http://www.w3.org/2001/XMLSchema#unsignedByte', 'integer', false],
    ['String[]', 'text', true],
    ['Set<Integer>', 'integer', true],
    ['urn:x-rois:def:DataType:OMG::double[]', 'number', true],
    ['RoIS_Identifier', 'identifier', false],
    ['Component_Status', 'component_status', false],
    ['StreamStatus', 'stream_status', false],
    ['NBestType', 'text', false],
    ['whatever', 'text', false],
    ['DateTime', 'date_time', false],
  ])('%s', (code, kind, is_list) => expect(data_type(code)).toMatchObject({ kind, is_list }));

  test.each<[string, string, boolean]>([
    ['int', '2147483647', true],
    ['int', '2147483648', false],
    ['int', ' +5 ', true],
    ['int', '1.0', false],
    ['long', '9223372036854775807', true],
    ['long', '9223372036854775808', false],
    ['unsignedByte', '-1', false],
    ['positiveInteger', '0', false],
    ['double', '1e3', true],
    ['double', '-INF', true],
    ['double', 'NaN', true],
    ['double', '1,5', false],
    ['bool', '1', true],
    ['bool', 'yes', false],
    ['DateTime', '2026-02-28T23:59:59.5+09:00', true],
    ['DateTime', '2026-02-29T00:00:00Z', false],
    ['DateTime', '2024-02-29T00:00:00Z', true],
    ['DateTime', '2026-02-28T24:00:00Z', false],
    ['DateTime', '2026-02-28T12:00:00', false],
    ['Date', '2026-02-28', true],
    ['Date', '2026-13-01', false],
    ['Time', '12:00:00', true],
    ['Time', '12:00', false],
    ['Time', '12:00:00+14:30', false],
    ['RoISIdentifier', '  ', false],
    ['Component_Status', 'READY', true],
    ['Component_Status', 'ready', false],
    ['Stream_Status', 'STREAMING_RESUMED', true],
    ['string', '', true],
    ['string', '\u0001', false],
    ['whatever', 'anything', true],
  ])('%s %j: %s', (code, text, is_good) => expect(problem_of(data_type(code), text) === undefined).toBe(is_good));
});

describe('descriptions', () => {
  test('name units', () => {
    expect(units_of('Distance in millimetre and direction in degree. Either this or curve is mandatory.')).toEqual(['mm', '°']);
    expect(units_of('The places, in order: "x, y, th" in millimetre, millimetre, degree. Mandatory.')).toEqual(['mm', 'mm', '°']);
    expect(units_of('After how long the way is given up, in millisecond; 0: never.')).toEqual(['ms']);
    expect(units_of('How loud. Optional.')).toEqual([]);
    expect(units_of()).toEqual([]);
  });

  test('name choices and needs', () => {
    expect(choices_of('What the route saves: `time` or `distance`. Optional.')).toEqual(['time', 'distance']);
    expect(choices_of('As in `target_position`.')).toEqual([]);
    const described = (description: string, default_value?: string): ParameterProfile => ({ ...asked('a', 'int', { description }), ...(default_value !== undefined && { default_value }) });
    expect(need_of(described('The reaction. Mandatory.'))).toEqual({ kind: 'needed' });
    expect(need_of(described('The reaction. Mandatory.', '1'))).toEqual({ kind: 'optional' });
    expect(need_of(described('What. Either this or SSML_text is mandatory.'))).toEqual({ kind: 'either', other: 'SSML_text' });
    expect(need_of(described('How loud. Optional.'))).toEqual({ kind: 'optional' });
    expect(shown_description('What the route saves: `time` or `distance`. Optional.')).toBe('What the route saves: time or distance.');
    expect(shown_description('Speaks (table 44).')).toBe('Speaks.');
    expect(shown_description('Follows (7.6.15), at 2 (or 3) m.')).toBe('Follows, at 2 (or 3) m.');
    expect(is_position(asked('target_position', 'string[]'))).toBe(true);
    expect(is_position(asked('time_limit', 'int', { description: 'in "x, y"' }))).toBe(false);
    expect(fixed_length(asked('line', 'int[]', { description: 'Distance in millimetre and direction in degree.' }))).toBe(2);
    expect(fixed_length(asked('target', 'string[]', { description: '"x, y, th" in millimetre, millimetre, degree.' }))).toBe(0);
  });

  test("start takes the component's parameters, another command its own arguments", async () => {
    const world = new World();
    world.answers.set('get_profile', () =>
      profile_xml({
        lamp: {
          type: 'Lamp',
          messages: '<rois:MessageProfile xsi:type="rois:CommandMessageProfileType" rois:name="blink"><rois:Arguments rois:name="times"><rois:data_type_ref rois:code="int"/></rois:Arguments><rois:Arguments rois:name="pause" rois:default_value="5"><rois:data_type_ref rois:code="int"/></rois:Arguments></rois:MessageProfile>',
          parameters: '<rois:ParameterProfile rois:name="colour" rois:description="Mandatory."><rois:data_type_ref rois:code="string"/></rois:ParameterProfile>',
        },
      }),
    );
    const console = await world.console();
    const [view] = views_of(console.profile.profile.value!);
    expect(asked_by(view!, 'start').map((one) => [one.name, one.need.kind])).toEqual([['colour', 'needed']]);
    expect(asked_by(view!, 'set_parameter').map((one) => [one.name, one.need.kind])).toEqual([['colour', 'optional']]);
    expect(asked_by(view!, 'blink').map((one) => [one.name, one.need.kind])).toEqual([['times', 'needed'], ['pause', 'optional']]);
    expect(asked_by(view!, 'stop')).toEqual([]);
    expect(command_types(view!)).toEqual(['blink', 'start', 'stop', 'suspend', 'resume', 'set_parameter']);
  });
});

describe('input', () => {
  const speech: Asked[] = [
    asked('speech_text', 'string', { need: { kind: 'either', other: 'SSML_text' } }),
    asked('SSML_text', 'string', { need: { kind: 'either', other: 'speech_text' } }),
    asked('volume', 'int'),
  ];

  test('is validated', () => {
    expect(problems_of(speech, {})).toEqual({ speech_text: { what: 'either', other: 'SSML_text' }, SSML_text: { what: 'either', other: 'speech_text' } });
    expect(problems_of(speech, { speech_text: { texts: ['Hello'] }, volume: { texts: ['loud'] } })).toEqual({ volume: { what: 'not_of_kind', kind: 'integer' } });
    expect(problems_of(speech, { SSML_text: { texts: [''], is_empty: true } })).toEqual({});
    expect(problems_of(speech, {}, (name) => name === 'SSML_text')).toEqual({});
    const line = asked('line', 'int[]', { description: 'Distance in millimetre and direction in degree.' });
    expect(problems_of([line], { line: { texts: ['1000', ''] } })).toEqual({ line: { what: 'missing' } });
    expect(problems_of([line], { line: { texts: ['1000', 'x'] } })).toEqual({ line: { what: 'not_of_kind', kind: 'integer' } });
    expect(problems_of([line], { line: { texts: ['1000', '90'] } })).toEqual({});
  });

  test('becomes parameters with the types of the profile', () => {
    const all = [asked('text', 'string'), asked('line', 'int[]'), asked('to', 'string[]'), asked('who', 'RoISIdentifier'), asked('none', 'urn:x-rois:def:DataType:ATR::Integer')];
    const inputs = { text: { texts: [' Hello '] }, line: { texts: ['1000 ', '-90'] }, to: { texts: ['desk', '', '1, 2'] }, who: { texts: ['person-1'] } };
    const parameters = parameters_from(all, inputs, (_, code) => (code === 'person-1' ? 'urn:track' : undefined));
    expect(parameters).toEqual([
      { name: 'text', data_type_ref: { code: 'string' }, values: [' Hello '] },
      { name: 'line', data_type_ref: { code: 'int[]' }, values: ['1000 -90'] },
      { name: 'to', data_type_ref: { code: 'string[]' }, values: ['desk', '1, 2'] },
      { name: 'who', data_type_ref: { code: 'RoISIdentifier', codebook_ref: 'urn:track' }, values: ['person-1'] },
    ]);
    expect(inputs_of(parameters)).toEqual({ text: { texts: [' Hello '] }, line: { texts: ['1000', '-90'] }, to: { texts: ['desk', '1, 2'] }, who: { texts: ['person-1'] } });
  });

  test('may be empty on purpose', () => {
    const all = [asked('text', 'string'), asked('list', 'string[]')];
    const empty = { text: { texts: [], is_empty: true }, list: { texts: [], is_empty: true } };
    expect(parameters_from(all, empty).map((one) => one.values)).toEqual([[''], []]);
    expect(inputs_of(parameters_from(all, empty))).toEqual(empty);
  });

  test('is dropped when it is deleted', () => {
    const inputs = with_input({}, 'a', { texts: ['1'] });
    expect(inputs).toEqual({ a: { texts: ['1'] } });
    expect(with_input(inputs, 'a', { texts: [''] })).toEqual({});
    expect(with_input(inputs, 'a', undefined)).toEqual({});
    expect(with_input(inputs, 'a', { texts: ['', ''] })).toEqual({ a: { texts: ['', ''] } });
  });
});

describe('the list of choices', () => {
  const at = { codebook: 'urn:track', component: 'c', crs: '', x: 0, y: 0, z: 0, at: 0 } as const;
  const person = { ...at, ref: 'person-1', kind: 'person', is_seen: true, identity: { ref: 'tanaka', codebook: 'urn:visitor', at: 0 } };
  const things = {
    places: ['desk', 'exit'],
    robots: [{ ...at, ref: 'robot1', codebook: 'urn:robot' }],
    entities: [person, { ...person, ref: 'person-2', is_seen: false }, { ...person, ref: 'face-1', kind: 'face', identity: undefined }],
    components: ['navigation'],
    parameters: new Results([
      { name: 'synthesizable_languages', ...value.strings(['en', 'ja']) },
      { name: 'available_reactions', data_type_ref: { code: 'RoISIdentifier[]', codebook_ref: 'urn:reaction' }, values: ['1', '2'] },
    ]),
  } as unknown as Things;
  test('has names if the codebook is known', () => {
    const codebook = 'urn:x-rois:def:codebook:simulation::reaction';
    const parameters = new Results([{ name: 'available_reactions', data_type_ref: { code: 'RoISIdentifier[]', codebook_ref: codebook }, values: ['9', '51'] }]);
    expect(options_for(asked('reaction_ref', 'RoISIdentifier'), { ...things, parameters }).list).toEqual([{ value: '9', codebook, label: 'bow the head' }, { value: '51', codebook }]);
    expect(with_name(codebook, '28')).toBe('28 – wave the hand');
    expect(with_name('urn:other', '28')).toBe('28');
  });

  const chosen = (one: Asked) => options_for(one, things).list.map((option) => option.value);

  test('has the components, places and people that the console knows', () => {
    expect(chosen(asked('target_position', 'string[]'))).toEqual(['desk', 'exit']);
    expect(chosen(asked('target_object_ref', 'RoISIdentifier'))).toEqual(['person-1', 'tanaka', 'robot1']);
    expect(chosen(asked('person_ref', 'RoISIdentifier'))).toEqual(['person-1', 'tanaka']);
    expect(chosen(asked('face_ref', 'RoISIdentifier'))).toEqual(['face-1']);
    expect(chosen(asked('visitor_ref', 'string'))).toEqual(['tanaka']);
    expect(chosen(asked('robot_ref', 'RoISIdentifier'))).toEqual(['robot1']);
    expect(chosen(asked('component_ref', 'RoISIdentifier'))).toEqual(['navigation']);
    expect(chosen(asked('language', 'string'))).toEqual(['en', 'ja']);
    expect(options_for(asked('reaction_ref', 'RoISIdentifier'), things).list[1]).toEqual({ value: '2', codebook: 'urn:reaction' });
    expect(chosen(asked('volume', 'int'))).toEqual([]);
  });

  test('is closed if no other values are valid', () => {
    expect(options_for(asked('on', 'bool'), things)).toEqual({ list: [{ value: 'true' }, { value: 'false' }], is_closed: true });
    expect(options_for(asked('policy', 'string', { description: '`time` or `distance`.' }), things).is_closed).toBe(true);
    expect(options_for(asked('language', 'string'), things).is_closed).toBe(false);
  });
});
