"""The parts of ./dev bench. Each has `round(keep, settings)`, which measures its rows once and passes each result to `keep(row, result)`."""

import dataclasses


@dataclasses.dataclass(frozen=True)
class Settings:
    seconds: float  # of one measurement
    turns: int  # measurements in a round, of rows that are compared
    connections: int  # idle connections that the part memory holds
    gateway: tuple = ()  # further arguments of rois-gateway

