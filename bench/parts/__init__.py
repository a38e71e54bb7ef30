"""The parts of ./dev bench. Each has `round(keep, settings)`: measures every row of its own once and keeps what came out."""

import dataclasses


@dataclasses.dataclass(frozen=True)
class Settings:
    seconds: float  # each measurement
    turns: int  # in a round, of rows that are compared
    connections: int  # that many are held where it says 10,000
    gateway: tuple = ()  # further arguments of the gateway

