// The robots' current motions, each with a stop button.
import { useConsole } from '../context';
import { Button, tried } from '../ui';
import { motions_of, stop } from './driving';
import { type Goal, goals_of, useGoals } from './goals';
import { age } from './formats';
import { session_of } from './session';
import * as texts from './texts';

export function Motions() {
  const console = useConsole();
  const session = session_of(console);
  useGoals();
  void console.now.value;
  const goals = goals_of(console, session.scene().shown);
  const rows = session.drivers().flatMap((driver) => {
    const motion = motions_of(console, driver).at(-1);
    const goal = goals.find((one) => one.driver.engine === driver.engine);
    return motion || goal ? [{ driver, motion, goal }] : [];
  });
  if (rows.length === 0) return null;
  return (
    <ul class="map-motions">
      {rows.map(({ driver, motion, goal }) => (
        <li key={driver.engine} class="map-motion">
          <span>{words(goal?.robot?.ref ?? driver.name, goal)}</span>
          {motion ? (
            <>
              <span class="map-soft">
                {motion.state === 'waiting' ? texts.waits() : age(console.environment.now() - (motion.started_at ?? motion.sent_at))}
              </span>
              <Button
                small
                look="danger"
                icon="stop"
                aria-label={texts.stop_robot(driver.name)}
                onClick={() => tried(console, driver.engine, stop(console, driver))}
              >
                {texts.stop()}
              </Button>
            </>
          ) : (
            <span class="map-soft">{texts.by_others()}</span>
          )}
        </li>
      ))}
    </ul>
  );
}

function words(robot: string, goal: Goal | undefined): string {
  if (!goal) return texts.moves(robot);
  return goal.kind === 'follow' ? texts.follows(robot, goal.text) : texts.moves_to(robot, goal.text);
}
