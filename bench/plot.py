"""Draws the growth of a request's CPU time, and values over time, as self-contained SVGs."""

from parts import growth

WIDTH, HEIGHT = 760, 420
LEFT, RIGHT, TOP, BOTTOM = 60, 230, 40, 50
COLOURS = ("#1b6ca8", "#c0392b", "#2e8b57", "#8e5bb5", "#b8860b", "#17889b", "#c2548f")


def _x(place, count):
    return LEFT + (WIDTH - LEFT - RIGHT) * place / max(1, count - 1)


def _y(value, most):
    return HEIGHT - BOTTOM - (HEIGHT - TOP - BOTTOM) * value / most


def _text(x, y, text, anchor="middle", colour="#333"):
    return f'<text x="{x:.0f}" y="{y:.0f}" text-anchor="{anchor}" fill="{colour}">{text}</text>'


def svg(medians):
    """The CPU time of a request along each axis, relative to the first point of the axis."""
    lines = {}
    for axis, numbers in growth.AXES.items():
        costs = [medians[growth.row(axis, number)]["cpu_us"] for number in numbers if growth.row(axis, number) in medians]
        if len(costs) == len(numbers):
            lines[axis] = [cost / costs[0] for cost in costs]
    most = max(2.0, min(6.0, 1.1 * max((max(line) for line in lines.values()), default=2.0)))
    out = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" font-size="12">',
        f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>',
        _text(LEFT, 22, "CPU of a request, relative to the smallest number of each line", "start"),
    ]
    for step in range(int(most) + 1):
        y = _y(step, most)
        out.append(f'<line x1="{LEFT}" x2="{WIDTH - RIGHT}" y1="{y:.0f}" y2="{y:.0f}" stroke="#ddd"/>')
        out.append(_text(LEFT - 8, y + 4, f"{step}", "end"))
    goal = _y(1.2, most)
    out.append(f'<line x1="{LEFT}" x2="{WIDTH - RIGHT}" y1="{goal:.0f}" y2="{goal:.0f}" stroke="#333" stroke-dasharray="4 4"/>')
    out.append(_text(WIDTH - RIGHT + 8, goal + 4, "goal: 1.2", "start"))
    for place, (axis, line) in enumerate(lines.items()):
        colour, numbers = COLOURS[place], growth.AXES[axis]
        shown = [(_x(i, len(line)), _y(min(value, most), most)) for i, value in enumerate(line)]
        points = " ".join(f"{x:.1f},{y:.1f}" for x, y in shown)
        out.append(f'<polyline points="{points}" fill="none" stroke="{colour}" stroke-width="2"/>')
        out += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3" fill="{colour}"/>' for x, y in shown]
        y = TOP + 60 + 34 * place
        out.append(_text(WIDTH - RIGHT + 8, y, axis, "start", colour))
        out.append(_text(WIDTH - RIGHT + 8, y + 14, f"{numbers[0]:,} to {numbers[-1]:,}: {line[-1]:.2f}", "start", "#777"))
    out.append(_text((LEFT + WIDTH - RIGHT) / 2, HEIGHT - 18, f"from the smallest number to the largest; values above {most:.3g} are clipped"))
    out.append("</svg>")
    return "\n".join(out) + "\n"


def series(values, units):
    """Each measure over time, one below the other. `values`: measure -> its value in each second."""
    height = 160
    out = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height * len(values)}" font-family="sans-serif" font-size="12">',
        f'<rect width="{WIDTH}" height="{height * len(values)}" fill="white"/>',
    ]
    for place, (name, line) in enumerate(values.items()):
        top, bottom, most = height * place + 34, height * (place + 1) - 24, 1.1 * max(line)
        points = [(LEFT + (WIDTH - LEFT - 30) * i / max(1, len(line) - 1), bottom - (bottom - top) * value / most) for i, value in enumerate(line)]
        out.append(_text(LEFT, top - 10, f"{name}, {units[name]}".rstrip(", "), "start"))
        for level in (0, most / 2, most):
            y = bottom - (bottom - top) * level / most
            out.append(f'<line x1="{LEFT}" x2="{WIDTH - 30}" y1="{y:.0f}" y2="{y:.0f}" stroke="#ddd"/>')
            out.append(_text(LEFT - 8, y + 4, f"{level:.3g}", "end"))
        out.append(f'<polyline points="{" ".join(f"{x:.1f},{y:.1f}" for x, y in points)}" fill="none" stroke="{COLOURS[place]}"/>')
        out.append(_text(WIDTH - 30, bottom + 16, f"{len(line):,} s", "end", "#777"))
    out.append("</svg>")
    return "\n".join(out) + "\n"
