// A group of conditions: the way of joining, its members, and buttons to add more.
import { Button, IconButton } from '../ui';
import { type Group, type Joining, new_group, new_predicate, type Node, with_added, with_changed, without, with_wrapped } from './model';
import { PredicateView } from './predicate_view';
import type { ConditionStore } from './store';
import * as texts from './texts';
import { WrittenView } from './written_view';

const joinings: readonly Joining[] = ['all_of', 'any_of', 'none_of', 'not_all_of'];

function joining_of({ joined, is_not }: Group): Joining {
  if (joined === 'And') return is_not ? 'not_all_of' : 'all_of';
  return is_not ? 'none_of' : 'any_of';
}

export function GroupView({ store, group, depth = 0 }: { store: ConditionStore; group: Group; depth?: number }) {
  const change = (to: Partial<Group>) => store.change_root((root) => with_changed(root, group.id, (one) => ({ ...one, ...to }) as Node));
  const join = (to: Joining) =>
    change({ joined: to === 'all_of' || to === 'not_all_of' ? 'And' : 'Or', is_not: to === 'none_of' || to === 'not_all_of' });
  const add = (node: Node) => store.change_root((root) => with_added(root, group.id, node));
  const is_root = depth === 0;
  const shows_join = !is_root || group.members.length > 1 || group.is_not;
  return (
    <fieldset class={is_root ? 'conditions-group conditions-root' : 'conditions-group'}>
      <legend class="unseen">{texts.joining_named(joining_of(group))}</legend>
      {shows_join && (
        <div class="conditions-join">
          <select aria-label={texts.join()} value={joining_of(group)} onChange={(event) => join(event.currentTarget.value as Joining)}>
            {joinings.map((one) => (
              <option key={one} value={one}>
                {texts.joining_named(one)}
              </option>
            ))}
          </select>
          {!is_root && (
            <IconButton
              small
              icon="close"
              label={texts.remove_group()}
              onClick={() => store.change_root((root) => without(root, group.id))}
            />
          )}
        </div>
      )}
      {group.members.length > 0 && (
        <ul class="conditions-members">
          {group.members.map((one) => (
            <li key={one.id}>
              <NodeView store={store} node={one} depth={depth + 1} />
            </li>
          ))}
        </ul>
      )}
      <div class="conditions-add">
        <Button small icon="plus" onClick={() => add(new_predicate())}>
          {texts.add_condition()}
        </Button>
        <Button small look="quiet" icon="plus" onClick={() => add(new_group([new_predicate()], 'Or'))}>
          {texts.add_group()}
        </Button>
      </div>
    </fieldset>
  );
}

function NodeView({ store, node, depth }: { store: ConditionStore; node: Node; depth: number }) {
  if (node.kind === 'group') return <GroupView store={store} group={node} depth={depth} />;
  const remove = () => store.change_root((root) => without(root, node.id));
  const wrap = () => store.change_root((root) => with_wrapped(root, node.id));
  if (node.kind === 'written') return <WrittenView store={store} node={node} remove={remove} />;
  return <PredicateView store={store} predicate={node} remove={remove} wrap={wrap} />;
}
