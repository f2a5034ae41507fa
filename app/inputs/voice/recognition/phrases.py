"""Phrases for each intent, by language. English sounds are in `app.inputs.voice.recognition.lexicon`; the others only a phone's own
recogniser knows, which gives words."""

from __future__ import annotations

from app.inputs.voice.recognition.lexicon import COMMANDS

__all__ = ["LANGUAGES", "PHRASES"]

LANGUAGES: dict[str, str] = {"en": "English", "de": "Deutsch", "es": "Español", "fr": "Français"}
"""Each language in its own words."""

PHRASES: dict[str, dict[str, tuple[str, ...]]] = {
    "en": COMMANDS,
    "de": {
        "stop": ("stopp", "stop", "halt", "notaus"),
        "pause": ("pause",),
        "resume": ("weiter", "weitermachen"),
        "start": ("start", "starten", "los"),
        "patrol": ("patrouille", "patrouille starten"),
        "go_home": ("nach hause", "heimfahren"),
        "end_task": ("aufgabe beenden",),
        "hold": ("position halten",),
        "surface": ("auftauchen",),
        "take_off": ("abheben",),
        "land": ("landen",),
        "faster": ("schneller",),
        "slower": ("langsamer",),
        "lights": ("licht",),
        "snapshot": ("foto", "bild aufnehmen"),
        "record": ("aufnahme", "aufzeichnen"),
        "camera": ("kamera",),
        "take_control": ("steuerung übernehmen",),
        "yes": ("ja", "bestätigen"),
        "no": ("nein", "abbrechen"),
    },
    "es": {
        "stop": ("alto", "para", "stop", "parada de emergencia"),
        "pause": ("pausa",),
        "resume": ("continuar", "seguir"),
        "start": ("empezar", "iniciar tarea"),
        "patrol": ("patrulla", "patrullar"),
        "go_home": ("volver a casa", "a casa"),
        "end_task": ("terminar tarea",),
        "hold": ("mantener posición",),
        "surface": ("superficie",),
        "take_off": ("despegar",),
        "land": ("aterrizar",),
        "faster": ("más rápido",),
        "slower": ("más lento",),
        "lights": ("luces",),
        "snapshot": ("foto",),
        "record": ("grabar",),
        "camera": ("cámara",),
        "take_control": ("tomar el control",),
        "yes": ("sí", "confirmar"),
        "no": ("no", "cancelar"),
    },
    "fr": {
        "stop": ("stop", "arrêt", "arrêt d'urgence"),
        "pause": ("pause",),
        "resume": ("reprendre", "continuer"),
        "start": ("démarrer", "commencer"),
        "patrol": ("patrouille", "patrouiller"),
        "go_home": ("retour maison", "rentrer"),
        "end_task": ("terminer la tâche",),
        "hold": ("tenir la position",),
        "surface": ("surface", "remonter"),
        "take_off": ("décoller",),
        "land": ("atterrir",),
        "faster": ("plus vite",),
        "slower": ("moins vite", "ralentir"),
        "lights": ("lumière",),
        "snapshot": ("photo",),
        "record": ("enregistrer",),
        "camera": ("caméra",),
        "take_control": ("prendre le contrôle",),
        "yes": ("oui", "confirmer"),
        "no": ("non", "annuler"),
    },
}
"""Language to intent to what may be said for it."""
