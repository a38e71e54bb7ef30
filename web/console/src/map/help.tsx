// Help: input methods and symbols.
import { is_touched } from '../i18n/i18n';
import { Dialog, Fact } from '../ui';
import * as texts from './texts';

export function Help({ open, close }: { open: boolean; close: () => void }) {
  const keys: [string[], string][] = [
    [['←', '→', '↑', '↓'], texts.key_arrows()],
    [['Enter'], texts.key_enter()],
    [['Q', 'E'], texts.key_turn()],
    [['Ctrl+Enter'], texts.key_send()],
    [['N', 'P'], texts.key_step()],
    [['+', '−', '0'], texts.key_zoom()],
    [['Esc'], texts.key_escape()],
  ];
  const signs = [
    ['robot', texts.kind('robot')],
    ['acts', `${texts.kind('robot')}, ${texts.sign_acts()}`],
    ['person', texts.kind('person')],
    ['known', `${texts.kind('person')}, ${texts.sign_known()}`],
    ['face', texts.kind('face')],
    ['sound', texts.kind('sound')],
    ['gone', texts.sign_gone()],
  ] as const;
  return (
    <Dialog title={texts.help_title()} open={open} close={close}>
      <div class="map-help">
        <h3>{texts.pointers()}</h3>
        <p>{texts.pointer_click()}</p>
        {!is_touched() && <p>{texts.pointer_aim()}</p>}
        <p>{texts.pointer_pan()}</p>
        {!is_touched() && (
          <>
            <h3>{texts.keys()}</h3>
            <dl class="map-keys">
              {keys.map(([names, what]) => (
                <Fact key={what} name={names.map((key) => <kbd key={key}>{key}</kbd>)}>{what}</Fact>
              ))}
            </dl>
          </>
        )}
        <h3>{texts.signs()}</h3>
        <ul class="map-signs">
          {signs.map(([sign, what]) => (
            <li key={sign}>
              <Sign of={sign} /> {what}
            </li>
          ))}
        </ul>
      </div>
    </Dialog>
  );
}

function Sign({ of }: { of: 'robot' | 'acts' | 'person' | 'known' | 'face' | 'sound' | 'gone' }) {
  return (
    <svg class={`map-sign map-sign-${of}`} width="26" height="26" viewBox="-13 -13 26 26" aria-hidden="true">
      {(of === 'robot' || of === 'acts') && (
        <>
          {of === 'acts' && <circle class="map-sign-ring" r="12" />}
          <circle r={of === 'acts' ? 8 : 10} />
          <path class="map-sign-inner" d="M7 0-5-5-2 0-5 5z" />
        </>
      )}
      {(of === 'person' || of === 'known' || of === 'gone') && (
        <>
          <path class="map-sign-nose" d="M12 0 6-3.5v7z" />
          <ellipse rx="5.5" ry="9" />
          <circle class="map-sign-inner" r="4" />
        </>
      )}
      {of === 'face' && <path d="M5 0 0 5-5 0 0-5z" />}
      {of === 'sound' && (
        <>
          <circle r="3" />
          <path class="map-sign-wave" d="M5-4.5a7 7 0 0 1 0 9M8-7a11 11 0 0 1 0 14M-5-4.5a7 7 0 0 0 0 9M-8-7a11 11 0 0 0 0 14" />
        </>
      )}
    </svg>
  );
}
