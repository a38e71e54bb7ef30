// A predicate as XML, without fields in the form.
import { Checkbox, IconButton, TextArea } from '../ui';
import { problems_of } from './checking';
import { type Node, with_changed, type Written } from './model';
import type { ConditionStore } from './store';
import * as texts from './texts';

export function WrittenView({ store, node, remove }: { store: ConditionStore; node: Written; remove: () => void }) {
  const change = (to: Partial<Written>) => store.change_root((root) => with_changed(root, node.id, (one) => ({ ...one, ...to }) as Node));
  const problem = problems_of(node, []).length > 0 ? texts.problem_named('no_xml') : undefined;
  return (
    <div class="conditions-predicate">
      <div class="conditions-line">
        <div class="conditions-wide">
          <TextArea label={texts.as_xml()} value={node.xml} change={(xml) => change({ xml })} error={problem} rows={3} />
        </div>
      </div>
      <div class="conditions-tools">
        <IconButton small icon="close" label={texts.remove()} onClick={remove} />
      </div>
      <Checkbox label={texts.negate()} checked={node.is_not} change={(is_not) => change({ is_not })} />
    </div>
  );
}
