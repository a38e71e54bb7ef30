#!/usr/bin/env python3
"""Plants bugs into a copy of the project, and expects that the schedules find each of them.

    planted.py [WORDS...]     all bugs, or those whose name has one of the words
    planted.py --check        only checks that each bug can be planted: its text is in the project

The copy is in build/planted. ROIS_SCHEDULES is the number of schedules for each bug [20000]. It takes about an hour.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
COPY = ROOT / "build" / "planted"
ENGINE, JOURNAL = "server/engine", "server/engine/journal"

# Name, file, the text that is replaced, and by what.
BUGS = [
    ("two clients bind one component", f"{ENGINE}/registry.cpp", "if (component.bound_to != nullptr && component.bound_to != &session) return Bound::taken;", ""),
    ("commands begin while everything is stopped", f"{ENGINE}/command_interface.cpp", "if (everything_is_stopped_ && begins)", "if (begins && false)"),
    ("observers may bind", f"{ENGINE}/command_interface.cpp", "if (!may_command(session.rights.get(), component->ref().code)) {", "if (false) {"),
    ("events go to clients that may not see them", f"{ENGINE}/delivery.cpp", " || !is_seen_with(one.rights)", ""),
    ("motion without signs of life goes on", f"{ENGINE}/engine.cpp", "attempts([&] { hold_unproven_motion(now); });", ""),
    ("a command ends twice", f"{ENGINE}/commands/executor.cpp", "    if (command->state == Command::State::ended) return;\n    command->state = Command::State::ended;\n    command->status", "    command->state = Command::State::ended;\n    command->reported = false;\n    command->status"),
    ("what the disk did not take is forgotten", f"{JOURNAL}/recorder.cpp", "        changed_.add(given_);  // which could not be stored\n", ""),
    ("notifications are not stored", f"{JOURNAL}/recorder.cpp", "changes.notifications.push_back({session.number, std::move(each)});", ""),
    ("commands are not stored", f"{JOURNAL}/recorder.cpp", "if (command->session != nullptr && stores(*command->session)) changed_.commands.insert(command);", "static_cast<void>(command);"),
    ("notifications are shown before they are stored", f"{JOURNAL}/recorder.cpp", "    session.notifications->show_when_stored();\n", ""),
    ("a stop of everything is forgotten", f"{JOURNAL}/restoring.cpp", "everything_is_stopped_ = engine.is_stopped;", ""),
    ("commands are accepted before they are stored", f"{JOURNAL}/restoring.cpp", "if (!recorder_.stores(session) || !recorder_.must_wait()) {", "if (true) {"),
    ("a command begins although it was not stored", f"{JOURNAL}/restoring.cpp", "if (stored && stopped == nullptr) {", "if (stopped == nullptr) {"),
    ("commands are not restored", f"{JOURNAL}/restoring.cpp", "for (auto& command : commands) restore(session, std::move(command), now);", "static_cast<void>(commands);"),
    ("numbers begin again after a restart", f"{ENGINE}/notifications/notification_queue.cpp", "if (!entries_.empty()) shown_ = given_ = last_sequence_ = entries_.back().sequence;", ""),
    ("a full disk refuses stops", f"{ENGINE}/command_interface.cpp", "lasts ? recorder_.why_no_commands() : std::string{}", "recorder_.why_no_commands()"),
    ("the earlier session in a sub engine stays", "components/remote/remote_session.cpp", "std::string{has_ended} + number_of(command)}));\n    link_->send(client::document_of({Disconnect{}, std::string{opening}}));", "std::string{has_ended} + number_of(command)}));\n    end_earlier_session();"),
]


def copy():
    """Copies the files that differ."""
    names = subprocess.run(["git", "-C", ROOT, "ls-files"], check=True, capture_output=True, text=True).stdout.splitlines()
    for name in names:
        source, target = ROOT / name, COPY / "source" / name
        if not source.is_file() or (target.exists() and target.read_bytes() == source.read_bytes()):
            continue
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(source, target)


def build():
    subprocess.run(["cmake", "--build", COPY / "build", "-j", "2", "--target", "test_schedules"], check=True, stdout=subprocess.DEVNULL)


def found():
    """Returns what the schedules find."""
    environment = {"ROIS_SCHEDULES": "20000", **os.environ}
    ran = subprocess.run([COPY / "build" / "bin" / "test_schedules"], env=environment, capture_output=True, text=True)
    seeds = re.findall(r"ROIS_FIRST_SCHEDULE=\d+: .*", ran.stdout)
    return seeds[0] if seeds else (f"it ended with {ran.returncode}: {ran.stderr.strip()[-200:]}" if ran.returncode else None)


def check():
    for name, file, old, _ in BUGS:
        if (ROOT / file).read_text().count(old) != 1:
            sys.exit(f"{name}: {file} does not have this text once: {old}")


def main(*words):
    check()
    if words == ("--check",):
        return 0
    copy()
    if not (COPY / "build").exists():
        subprocess.run(["cmake", "-G", "Ninja", "-S", COPY / "source", "-B", COPY / "build", "-DCMAKE_BUILD_TYPE=Release"], check=True, stdout=subprocess.DEVNULL)
    build()
    if problem := found():
        sys.exit(f"without a bug: {problem}")
    missed = 0
    for name, file, old, new in BUGS:
        if words and not any(word in name for word in words):
            continue
        text = (ROOT / file).read_text()
        target = COPY / "source" / file
        target.write_text(text.replace(old, new))
        build()
        finding = found()
        missed += finding is None
        print(f"{'found' if finding else 'MISSED'}: {name}" + (f" ({finding})" if finding else ""), flush=True)
        target.write_text(text)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
