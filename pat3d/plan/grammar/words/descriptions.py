"""Words that only describe: set off behind a noun they are a remark on it, and name nothing beside it."""

from __future__ import annotations


def _words(text: str) -> frozenset[str]:
    return frozenset(text.split())


_DESCRIBING = _words("""
    handmade homemade handwritten handheld hand-held manmade man-made homespun handwoven handblown handspun
    handcraft hollow solid robust fragile brittle rigid stiff limp slack taut loose tight flimsy dense sparse
    lightweight heavyweight weightless airtight watertight waterproof windproof fireproof shockproof rustproof
    bulletproof leakproof childproof soundproof ovenproof foolproof shatterproof see-through see-thru sheer murky
    cloudy milky foamy frothy unused brand-new secondhand second-hand hand-me-down heirloom collectible medieval
    victorian colonial gothic baroque bohemian art-deco nordic scandinavian japanese chinese french italian spanish
    mexican indian persian moroccan turkish greek roman egyptian african korean swiss belgian dutch english british
    american german russian traditional old-fashioned old-world old-school vintage-looking timeworn worn-out beat-up
    run-down threadbare shabby tatty grubby filthy spotless immaculate flawless imperfect perfect misshapen lopsided
    crooked wonky wobbly wavy curly bushy furry hairy shaggy woolly fuzzy silky velvety satiny slippery slimy gooey
    greasy oily soggy sandy muddy grassy snowy icy frosty misty steamy smoky grimy rotten mouldy moldy stale rancid
    raw overripe unripe uneaten leftover lukewarm tepid boiling freezing chilly toasty crispy chewy flaky crumbly
    buttery cheesy nutty peppery zesty tangy savoury savory bland decadent delicious yummy nutritious vegan
    vegetarian organic gluten-free sugar-free fat-free dairy-free low-fat wholegrain whole-grain free-range decaf
    double-decker double-sided one-sided two-sided all-purpose multi-purpose general-purpose heavy-duty high-end
    low-end top-notch high-tech low-tech hi-tech state-of-the-art cutting-edge run-of-the-mill off-the-shelf
    made-to-order ready-made custom-made tailor-made purpose-built home-made store-bought shop-bought factory-made
    mass-market limited-edition one-off one-piece two-piece three-piece two-tier three-tier two-tone two-ply
    three-ply full-size life-size king-size queen-size twin-size pint-size pocket-size travel-size bite-size
    kid-size adult-size oversize undersize extra-large extra-small jumbo gigantic colossal immense teeny teeny-tiny
    petite dainty chubby stocky squat stout lanky bulky chunky clunky boxy curvy pear-shape egg-shape oblong oval
    elliptic conical cubic spherical cylindrical hexagonal octagonal pentagonal concave convex spiral zigzag
    criss-cross flat-pack cordless wireless solar electric manual automatic digital analog analogue mechanical
    hydraulic pneumatic magnetic clip-on stick-on snap-on screw-on pull-out pop-up fold-out fold-up roll-up wind-up
    push-button plug-in built-in stand-alone freestanding standalone free-standing upside-down inside-out face-up
    face-down right-side-up top-heavy off-kilter luxurious deluxe premium cheap pricey inexpensive affordable
    thrifty rare scarce exotic fanciful whimsical quirky gaudy tacky kitsch kitschy glam glamorous glitzy sparkly
    glittery lustrous iridescent fluorescent neon drab dull plain-looking cute-looking old-looking new-looking
    heavy-looking expensive-looking cheap-looking half-burnt half-full half-empty half-open half-shut half-eaten
    half-drunk half-read half-built half-worn sunlit moonlit candlelit backlit frost-free crystal-clear rock-hard
    paper-thin wafer-thin razor-thin razor-sharp rock-solid feather-light
""")
_ENDINGS = ("-burnt", "-made", "-worn", "-eaten", "-built", "-bound", "-woven", "-spun", "-like", "-style", "-looking",
            "-free", "-proof", "-resistant", "-friendly", "-size", "-sized", "-shaped", "-themed", "-cut", "-torn",
            "-blown", "-sewn", "-drawn", "-thin", "-thick", "-lit", "-broken", "-frozen")  # fmt: skip


def only_describes(word: str) -> bool:
    """Whether `word` is an ordinary word for the make, the age or the state of a thing: "half-burnt", "handmade"."""
    return word in _DESCRIBING or word.endswith(_ENDINGS)
