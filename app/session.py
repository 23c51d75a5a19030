"""One person's session: what they do comes in as messages, one change is one solve and one packet out."""

import json
import logging

from . import around, export, link
from .comparison import Comparing
from .form import form, scale
from .packet import Buffer, Drawing
from .page import Page
from .presets import PRESETS
from .quantities import CHOICES, QUANTITIES
from .state import Explorer
from .tip import read_tip
from .trajectory import follow
from .units import fitting, read

_LOG = logging.getLogger(__name__)
_MOST_UNDO = 100


class Session:
    """What one person sees and does."""

    def __init__(self, arguments=None):
        self.state, self.notice = Explorer(), ""
        self.past, self.future, self._last = [], [], None
        self.drawing = self.held = None
        self.axes, self._answered = {}, 0
        self.comparing = Comparing(lambda message: self.page.send(message))
        if arguments:
            self._open(arguments)
        if self.drawing is None:
            self._solve()
        self.page = Page(self.receive)
        self._show()

    def _open(self, arguments):
        try:
            self.state = link.restore(arguments)
            self._solve()
        except Exception as error:
            self.notice = f"The link was not opened: {self._refusal(error)}"
            self.state, self.drawing = Explorer(), None

    def receive(self, message):
        """Do what a person asks for; if it is refused say why, and keep everything as it was."""
        self._answered = message.get("n") if isinstance(message.get("n"), int) else self._answered
        act = _ACTIONS.get(message["do"]) if isinstance(message.get("do"), str) else None
        before, drawing, kept = self.state.snapshot(), self.drawing, (self.past, self.future)
        try:
            if act is not None and act(self, message):
                self._solve()
                self._remember(before, message)
            self._show()
        except Exception as error:
            self.notice = self._refusal(error)
            self.state.restore(before)
            self.drawing, (self.past, self.future) = drawing, kept
            self._show()

    def _refusal(self, error):
        """What is said of an error; one that is not the person's is logged with what led to it."""
        if isinstance(error, ValueError):
            return str(error)
        _LOG.error("a change could not be shown, scene %s", self.state.described(), exc_info=error)
        return "this cannot be shown, because of a fault of the explorer. Everything is as it was before."

    def _solve(self):
        self.comparing.cancel()
        self.drawing = Drawing(follow(self.state.scene(), self.state.progress))

    def _remember(self, before, message):
        """Keep what was for undo; a drag of one slider counts as one change."""
        if message["do"] in ("undo", "redo", "stand"):
            return
        mark = (message["do"], message.get("name")) if message["do"] == "move" else None
        if mark is None or mark != self._last:
            self.past = [*self.past[1 - _MOST_UNDO :], before]
        self._last, self.future = mark, []

    # What can be asked for. Each returns whether the scene has to be solved anew.

    def _move(self, message):
        name, position = message.get("name"), message.get("position")
        if name not in QUANTITIES or not isinstance(position, (int, float)):
            raise ValueError("this slider is not known")
        self.state.set(name, scale(self.state, name).value(position))
        return True

    def _type(self, message):
        name, text = message.get("name"), message.get("text")
        if name not in QUANTITIES or not isinstance(text, str):
            raise ValueError("this field is not known")
        kind = QUANTITIES[name].kind
        self.state.set(name, read(text, kind, fitting(self.state.numbers[name], kind)))
        self.state.resets = {name: self.state.numbers[name]} | self.state.resets
        return True

    def _double(self, message):
        name = message.get("name")
        if name in self.state.resets:
            self.state.set(name, self.state.resets[name])
        return True

    def _choose(self, message):
        name, option = message.get("name"), message.get("option")
        if name not in CHOICES or not isinstance(option, str):
            raise ValueError("this choice is not known")
        self.state.choose(name, option)
        return True

    def _load(self, message):
        if message.get("label") not in PRESETS:
            raise ValueError("this preset is not known")
        self.state.load(message["label"])
        return True

    def _reset(self, message):
        self.state.load(self.state.preset)
        return True

    def _undo(self, message):
        return self._step("past", "future")

    def _redo(self, message):
        return self._step("future", "past")

    def _step(self, source, target):
        steps = getattr(self, source)
        if not steps:
            return False
        setattr(self, target, [*getattr(self, target), self.state.snapshot()])
        setattr(self, source, steps[:-1])
        self.state.restore(steps[-1])
        self._last = None
        return True

    def _again(self, message):
        """The same body hits the same spot once more."""
        hit = self.drawing.trajectory.hit
        if hit is None:
            raise ValueError("only an impact can be repeated")
        if not hit.growth > 0:
            raise ValueError("nothing has yielded further: the next impact is the same as this one")
        self.state.hit_again(float(hit.plastic_depth))
        return True

    def _hold(self, message):
        """Hold what is seen, at the state at which the page stands just now; or let go of what is held."""
        self._reach(message)
        self.held = None if self.held is not None else self.drawing
        self._held_name = around.summary(self.state)
        return False

    def _reach(self, message):
        """Stand where the page stands, which it tells only once it has been still."""
        if "at" in message and float(message["at"]) != self.state.progress:
            self.state.move(float(message["at"]))
            self._solve()

    def _stand(self, message):
        """The page stands at another state; it has drawn that already."""
        self.state.move(float(message["at"]))
        return True

    def _upload(self, message):
        text = message.get("text")
        if not isinstance(text, str) or len(text) > link.LARGEST_FILE:
            raise ValueError("the file is larger than 2 MB")
        if message.get("kind") == "scene":
            self.state = link.from_scene(text, self.state)
        else:
            self.state.upload(read_tip(text))
        return True

    def _frames(self, message):
        """Send the fields of all states along the way, so that the page can move through them alone."""
        trajectory, buffer = self.drawing.trajectory, Buffer()
        self.drawing.fields(buffer, self.axes, range(len(trajectory.progress)))
        self.page.send(
            {"frames": self._sequence, "places": json.dumps(buffer.places), "values": buffer.joined()}
        )
        return False

    def _compare(self, message):
        """Solve the scene by every model, beside all else, or no longer."""
        if message.get("on"):
            self.comparing.start(self.drawing.trajectory.scene, self._sequence)
        else:
            self.comparing.cancel()
        return False

    def _file(self, message):
        self._reach(message)
        trajectory = self.drawing.trajectory
        files = {
            "curves": ("curves.csv", export.csv),
            "pressure": ("pressure.csv", export.pressure_csv),
            "scene": ("scene.json", link.scene_file),
            "python": ("scene.py", self._python),
        }
        if message.get("what") in files:
            name, write = files[message["what"]]
            self.page.send({"file": name, "what": message["what"], "text": write(trajectory)})
        return False

    def _python(self, trajectory):
        return export.python(trajectory, self.held and self.held.trajectory)

    _sequence = 0

    def _show(self):
        """Send what is drawn: one buffer, and one text with all that is not drawn."""
        drawing, held = self.drawing, self.held
        trajectory, state = drawing.trajectory, self.state
        axes, buffer = drawing.axes(held), Buffer()
        energy = drawing.moving(buffer, axes)
        drawing.still(buffer, axes)
        drawing.fields(buffer, axes, [trajectory.now])
        if held is not None:
            held.held(buffer, axes)
        if axes != self.axes or drawing is not self._shown:
            self._sequence += 1
        self.axes, self._shown = axes, drawing
        meta = {
            "seq": self._sequence,
            "answered": self._answered,
            "axes": axes,
            "energy": energy,
            "places": buffer.places,
            "progress": trajectory.progress.tolist(),
            "now": trajectory.now,
            "peak": trajectory.peak,
            "onset": _onset(trajectory),
            "tau": trajectory.scene.medium.relaxation_time,
            "speed": float(trajectory.motion.velocity[0]) if trajectory.motion is not None else 0.0,
            "impact": trajectory.motion is not None,
            "numbers": around.numbers(trajectory),
            "form": form(state, trajectory.scene.medium),
            "sketch": around.sketch(trajectory, state.shape),
            "lights": around.lights(trajectory, self._density()),
            "sources": around.sources(state.preset),
            "query": link.query(state),
            "undo": [bool(self.past), bool(self.future)],
            "held": self._held_name if held is not None else None,
            "notice": self.notice,
        }
        self.notice = ""
        self.page.show(json.dumps(meta, allow_nan=False), buffer.joined())

    _shown = None

    def _density(self):
        known = self.state.choices["inertia"] == "density"
        return self.state.numbers["density"] if known else None


_ACTIONS = {
    "move": Session._move,
    "type": Session._type,
    "double": Session._double,
    "choose": Session._choose,
    "load": Session._load,
    "reset": Session._reset,
    "again": Session._again,
    "undo": Session._undo,
    "redo": Session._redo,
    "hold": Session._hold,
    "stand": Session._stand,
    "upload": Session._upload,
    "frames": Session._frames,
    "file": Session._file,
    "compare": Session._compare,
}


def _onset(trajectory):
    onset = trajectory.onset
    return None if onset is None else [float(onset.depth), float(onset.force)]
