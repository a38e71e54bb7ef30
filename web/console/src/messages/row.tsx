import { useConsole } from '../context';
import { clock_time } from '../i18n/i18n';
import { Badge, Icon, StatusBadge } from '../ui';
import { category_of, is_gap, type Row } from './feed';
import { command_of, component_of, expire_of, name_of, summary } from './summary';
import * as texts from './texts';

export function RowView({ row, is_live }: { row: Row; is_live: boolean }) {
  const { now, commands } = useConsole();
  if (is_gap(row))
    return (
      <span class="messages-gap">
        <Icon name="warning" size={14} />
        {clock_time(row.at)} {row.gap.reason === 'lost' ? texts.gap_lost(row.gap.count) : texts.gap_session()}
      </span>
    );
  const expire = expire_of(row);
  const is_expired = is_live && expire !== undefined && expire <= now.value;
  const status = row.return_code ?? (row.name === 'completed' ? /^\w+/.exec(summary(row))?.[0] : undefined);
  const command = is_live && row.name === 'completed' ? commands.find(command_of(row)) : undefined;
  const look = row.name === 'completed' && status !== 'OK' ? 'stopped' : category_of(row);
  return (
    <>
      <span class="messages-time">{clock_time(row.at, false)}<span class="messages-ms">{clock_time(row.at).slice(-4)}</span></span>
      <span class={`messages-way messages-way-${row.direction}`}>
        <Icon name={row.direction === 'out' ? 'up' : 'down'} size={12} />
        <span class="unseen">{row.direction === 'out' ? texts.outward() : texts.inward()}</span>
      </span>
      <span class={`messages-name messages-is-${look}`} title={row.name}>{name_of(row) || '—'}</span>
      <span class="messages-component">{command?.component ?? component_of(row)}</span>
      <span class="messages-summary">{summary(row)}{command && `  ${command.component} ${command.command_type}`}</span>
      {is_expired && <Badge>{texts.expired()}</Badge>}
      {status !== undefined && status !== 'OK' && <StatusBadge status={status} />}
      {row.name === 'fault' && <Badge tone="bad">fault</Badge>}
    </>
  );
}
