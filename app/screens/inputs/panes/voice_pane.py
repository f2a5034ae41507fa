"""The pane of voice: a meter, a try without consequences, what understands, when it listens, and how it talks."""

from __future__ import annotations

import math
from typing import Any

from kivy.uix.boxlayout import BoxLayout

from app.device import is_android
from app.inputs.voice.audio.noise import TOO_LOUD
from app.inputs.voice.interfaces.speech_recognizer import Level, Result
from app.inputs.voice.recognition.phrases import LANGUAGES, PHRASES
from app.inputs.voice.recognition.vosk_judge import model_fault
from app.inputs.voice.recognizers import BEST, RECOGNIZERS
from app.inputs.voice.speech.tts import VOICES
from app.inputs.voice.talkback import RATES, Talkback
from app.inputs.voice.voice_input import VoiceInput
from app.intents.intents import INTENTS
from app.screens.inputs.parts.pane_app import PaneApp
from app.screens.inputs.parts.setting_row import number_row, switch_row
from widgets.core.language import mark, tr
from widgets.inputs.noise_meter import NoiseMeter
from widgets.parts.kit import Column, ListRow, PrimaryButton, QuietButton, Roll, Segmented
from widgets.parts.labels import Remark
from widgets.parts.rows import group_label
from widgets.parts.text_field import TextField

__all__ = ["VoicePane"]

PUSH = mark(
    "Hold Talk at the edge of the screen, a key or a button of a gamepad while you speak; a tap listens for one command."
)
FREE = mark("It listens all the time. Among people who talk, hold the button instead.")
TRY = mark("Say a command: the result is shown, and only STOP acts.")
EXAMPLE = mark("Go home? Say yes or no.")


class VoicePane(BoxLayout):
    """A pane of the inputs screen."""

    def __init__(self, app: PaneApp, **kwargs: Any) -> None:
        super().__init__(orientation="vertical", spacing="8dp", **kwargs)
        self._app = app
        self.speaking: VoiceInput = app.methods.get("voice")
        """What hears."""
        self.talking: Talkback = app.methods.get("talk")
        """What talks."""
        self.meter = NoiseMeter(needed=TOO_LOUD, state="never")
        self.standing, self.how = Remark(font_size="15sp"), Remark(font_size="14sp")
        self.words: dict[str, ListRow] = {}
        self._column = Column(spacing="6dp")
        self._fill()
        roll = Roll()
        roll.add_widget(self._column)
        self.add_widget(roll)

    def _fill(self) -> None:
        add = self._column.add_widget
        add(self.standing)
        add(self.meter)
        self.trial = PrimaryButton(text=tr("Try it"), icon="mic", size_hint_y=None)
        self.trial.bind(on_release=lambda _: self._try())
        add(self.trial)
        add(group_label(tr("When it listens")))
        self.kind = Segmented(
            options=[("push", tr("Push to talk")), ("free", tr("Hands-free"))],
            size_hint_y=None,
            height="48dp",
        )
        self.kind.bind(on_choose=lambda _, value: self._listen_so(value))
        add(self.kind)
        add(self.how)
        self._fill_recognizers()
        self._fill_languages()
        self._fill_answers()
        add(group_label(tr("Phrases")))
        for intent in PHRASES["en"]:
            known = INTENTS[intent]
            self.words[intent] = ListRow(icon=known.icon, title=known.words, whole=True)
            add(self.words[intent])

    def _fill_answers(self) -> None:
        add = self._column.add_widget
        add(group_label(tr("Voice")))
        row, self.talks = switch_row(
            "volume_up", tr("Talk back"), tr("Answers, alarms, what the robot confirmed."), self._talk
        )
        add(row)
        self.voices = Segmented(
            options=[(name, tr(words)) for name, words in VOICES.items()], size_hint_y=None, height="48dp"
        )
        self.voices.bind(on_choose=lambda _, voice: self._choose_voice(voice))
        if not is_android():  # a phone's voice is chosen in Android's settings
            add(self.voices)
        row, self.rate = number_row(
            "speed",
            tr("How fast"),
            tr("1 is usual."),
            self._choose_rate,
            minimum=RATES[0],
            maximum=RATES[1],
            step=0.1,
            unit="×",
        )
        add(row)
        self.example = QuietButton(text=tr("Say something"), icon="volume_up", size_hint_y=None)
        self.example.bind(on_release=lambda _: self._say_something())
        add(self.example)
        self.trouble = Remark(font_size="14sp", role="warn")
        add(self.trouble)

    def _fill_recognizers(self) -> None:
        """Not on a phone, which has one of its own."""
        self.recognizers = Segmented(
            options=[(BEST, tr("Best")), *((name, tr(words)) for name, words in RECOGNIZERS.items())],
            size_hint_y=None,
            height="48dp",
        )
        self.recognizers.bind(on_choose=lambda _, name: self._choose_recognizer(name))
        self.model = TextField(label=tr("Vosk model"), hint_text=tr("Folder of a Vosk model"))
        self.model.bind(on_text_validate=lambda _: self._enter_model(), focus=self._on_model_focus)
        self._models = Column(spacing="6dp")
        if not is_android():
            self._column.add_widget(group_label(tr("Recogniser")))
            self._column.add_widget(self.recognizers)
            self._column.add_widget(self._models)

    def _fill_languages(self) -> None:
        """Only where what understands here knows more than one."""
        known = self.speaking.languages
        self.language = Segmented(
            options=[(name, LANGUAGES[name]) for name in known], size_hint_y=None, height="48dp"
        )
        self.language.bind(on_choose=lambda _, name: self._choose_language(name))
        if len(known) > 1:
            self._column.add_widget(group_label(tr("Language")))
            self._column.add_widget(self.language)

    # what a finger asks for

    def _try(self) -> None:
        self.speaking.try_out(on=not self.speaking.trying)
        self.tick()

    def _listen_so(self, value: str) -> None:
        self.speaking.hands_free = value == "free"
        self.tick()

    def _choose_recognizer(self, name: str) -> None:
        self.speaking.recognizer = name
        self.tick()

    def _on_model_focus(self, _: object, focus: bool) -> None:
        if not focus:
            self._enter_model()

    def _enter_model(self) -> None:
        if self.model.text.strip() != self.speaking.model:
            self.speaking.model = self.model.text
        self.tick()

    def _choose_language(self, name: str) -> None:
        self.speaking.language = name
        self.tick()

    def _talk(self, on: bool) -> None:
        self._app.methods.turn("talk", on)
        self.tick()

    def _choose_voice(self, voice: str) -> None:
        self.talking.voice = voice
        self.tick()

    def _choose_rate(self, rate: float) -> None:
        self.talking.rate = round(rate, 2)
        self.tick()

    def _say_something(self) -> None:
        self.talking.voice = self.talking.voice  # one that failed is tried again
        self.talking.say(tr(EXAMPLE), "answer")
        self.tick()

    # what the screen calls

    def enter(self) -> None:
        """Come onto the glass."""
        for intent, row in self.words.items():
            said = PHRASES[self.speaking.language].get(intent, ())
            row.detail = " · ".join(f"“{one}”" for one in said)
        self.tick()

    def leave(self) -> None:
        """Leave the glass, and the try with it."""
        self.speaking.try_out(on=False)

    def rest(self) -> None:
        """Nothing here is held."""

    def tick(self) -> None:
        """Bring up to date how it stands."""
        speaking, talking = self.speaking, self.talking
        self._show_meter(speaking)
        self.standing.role = "warn" if speaking.problem else "muted"
        self.standing.text = speaking.problem or self._usual(speaking)
        self.trial.text = tr("End the try") if speaking.trying else tr("Try it")
        self.trial.icon = "close" if speaking.trying else "mic"
        self.kind.value = "free" if speaking.hands_free else "push"
        self.how.text = tr(FREE) if speaking.hands_free else tr(PUSH)
        self._show_recognizer(speaking)
        self.language.value = speaking.language
        self.talks.active = talking.on
        self.voices.value, self.rate.value = talking.voice, round(talking.rate, 2)
        self.trouble.text = talking.problem

    def _show_recognizer(self, speaking: VoiceInput) -> None:
        self.recognizers.value = speaking.recognizer
        if (speaking.recognizer == "vosk") != (self.model.parent is self._models):
            (self._models.add_widget if speaking.recognizer == "vosk" else self._models.remove_widget)(
                self.model
            )
        if not self.model.focus:
            self.model.text = speaking.model
        self.model.wrong = speaking.recognizer == "vosk" and bool(model_fault(speaking.model))

    def _usual(self, speaking: VoiceInput) -> str:
        if speaking.trying:
            return tr(TRY)
        if not speaking.on:
            return tr(
                "Off: nothing listens and nothing is loaded. Switch it on in the list of inputs, or try it here."
            )
        return {"listening": tr("Listening."), "hold to talk": tr("Ready.")}.get(
            speaking.standing, tr("One moment …")
        )

    def _show_meter(self, speaking: VoiceInput) -> None:
        meter, level = self.meter, speaking.level
        open_ = speaking.ready and speaking.listening
        meter.state = "alarm" if speaking.loud else "live" if open_ else "never"
        told = level if open_ else Level(-math.inf, math.nan, math.nan)
        meter.update(
            level=told.level, noise=told.noise, snr=told.snr, speaking=told.speaking, clipped=told.clipped
        )
        last = speaking.last
        if isinstance(last, Result):
            meter.answer(f"{INTENTS[last.command].words}: “{last.said}”", last.confidence, understood=True)
        elif last is not None:
            meter.answer(speaking.said or last.reason, understood=False)
