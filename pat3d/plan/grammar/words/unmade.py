"""Words that name nothing that could stand anywhere: what is done, what something is like, where and when it is."""

from __future__ import annotations

from functools import cache

from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.lexing import singulars


def _words(text: str) -> frozenset[str]:
    return frozenset(text.split())


_DOINGS = _words("""
    restock replenish defrost mesh bypass buzz steam coil dock guard uncover shelve locate unzip hoist lug heave
    accept access accomplish achieve acquire activate adapt add adhere adjust admire adopt affect agree aid aim
    align allow announce answer anticipate appear apply appreciate approach arrange assemble assess assist associate
    assume attach attempt attend attract avoid await bake balance bask be beckon become begin believe belong bend
    blend block bloom boast boil borrow bother bounce break brew bring browse build bump burn burst bury buy
    calculate call capture care carry catch cause celebrate center centre challenge change chase check chew chill
    choose chop claim clamp clarify clean clear click climb close cluster collapse collect collide combine come
    compare compete complete compose comprise conduct confirm connect consider construct consume continue contribute
    control convert cook cool coordinate cope correspond cover crack cradle crawl create cross crumble crush cry
    cultivate curl cut dance dangle darken deal decide decorate define defy delight deliver demand demonstrate
    depend depict deposit describe deserve detach detect determine develop die diffuse dig dim dip disappear
    disassemble discard discover dispose distinguish distribute disturb divide do dock dominate doze drag drain
    drape draw dream dribble drift drip drive drop drown dry dump dwell earn ease eat echo elevate eliminate embody
    embrace emerge emit emphasise emphasize employ empty emulate enable encounter encourage end endure engage
    enhance enjoy ensure enter entice envelop erect erupt escape establish evaluate evoke examine exceed exchange
    excite execute exert exhibit exist expand expect explain explore expose express extend extract exude face fade
    fail fall feature feed feel fetch fight fill filter find finish fit fix flank flap flatten flicker flip float
    flow flutter fly focus fold follow force forget form free fry function fuse gain gather gaze get give glance
    gleam glide glimmer glint glisten glitter glow go govern grab grace grasp graze greet grip grow guard guess
    guide hand handle hang happen harmonise harmonize hear heat help hesitate hide highlight hint hit hold hop hope
    hover huddle hug hunt hurry identify ignore illuminate illustrate imagine imitate imply improve include increase
    indicate inform infuse inhabit insert inspect inspire install instruct intend interact interlock intersect
    introduce invert invite involve jam jiggle join jostle jump justify jut keep kick kill kneel knit knock know
    lack land lap last laugh launch lay lean leap learn leave lend let liberate lie lift like line linger link
    listen live load loom loosen lose lounge love lower lurk maintain make manage maneuver manipulate manoeuvre
    march match matter mean measure meet melt mention merge mimic mingle miss mix moisten monitor mount move mow
    multiply nap navigate need neglect nestle nibble nod notice nudge obey observe obtain occupy occur offer open
    operate oppose optimize organise organize orient originate overcome overflow overhang overlap overlook owe own
    pack pass pause peek peel peep peer perceive perch perform permit persist pick pierce pile pinch place plate
    play plead pluck plug point poke ponder pop populate pose position possess pour practice practise praise prefer
    prepare present preserve press pretend prevent proceed process produce project promise promote prompt prop
    protect protrude prove provide pull punctuate purchase push put puzzle radiate raise randomize reach react read
    realise realize rearrange recall receive recline recognise recognize recommend recover recycle refer refill
    reflect refresh regard regrasp reject relate relax release relocate remain remember remind remove render repeat
    replace reply report reposition represent require rescue resemble reset resolve respect respond rest restore
    result resume retain retract retrieve return reveal reverse rinse rise roast roll roost rotate rub ruin run rush
    sail satisfy saturate save savor savour say scan scatter scoop scrape scratch screw scrub seal search secure
    seek seem select sell send sense separate serve set settle shake shape share shift shimmer shine shove show
    shrink shut sigh signify simmer simulate sing sink sip sit sizzle skewer sleep slice slide slip slosh slouch
    slump slurp smash smell smile snap sneak snooze snuggle soak soar solve sort span spare sparkle speak spell
    spend spill spin splash split spoil sprawl spray spread sprinkle squat squeak squeeze stabilise stabilize stack
    stagger stamp stand stare start starve stash stay steal steer stick stir stop store stow strain stretch strike
    strive struggle study succeed suck suffer suggest suit support suppose surprise surround survey survive suspect
    sustain swallow swap sway sweep swell swim swing swirl switch swivel take talk tap taste tear tell tempt tend
    test thank thaw think thrive throw tidy tie tighten tilt tip topple toss touch tow tower trace trade train
    transfer transform transition translate transmit transport trap travel traverse treat tremble trickle trigger
    trim try tuck tug tumble turn twinkle twirl twist understand undo unfold unload unlock unpack unplug unscrew
    unstack untangle untie unveil unwind unwrap use utilise utilize vanish vary verify view visit wait wake walk
    wander want warm warn wash waste watch wave wear weave weigh welcome whisper wiggle win wipe wish withdraw
    withstand wobble wonder work worry wrap wrestle write yawn yield stream purr tick snore hum
""")  # fmt: skip
"""Verbs, whether or not a task does what they say."""
_IRREGULAR = {
    "was": "be", "were": "be", "been": "be", "am": "be", "became": "become", "began": "begin", "begun": "begin",
    "bent": "bend", "broke": "break", "broken": "break", "brought": "bring", "built": "build", "burnt": "burn",
    "bought": "buy", "caught": "catch", "chose": "choose", "chosen": "choose", "came": "come", "dealt": "deal",
    "did": "do", "done": "do", "does": "do", "drew": "draw", "drawn": "draw", "drove": "drive", "driven": "drive",
    "ate": "eat", "eaten": "eat", "fell": "fall", "fallen": "fall", "fed": "feed", "felt": "feel", "found": "find",
    "flew": "fly", "flown": "fly", "forgot": "forget", "forgotten": "forget", "froze": "freeze", "got": "get",
    "gotten": "get", "gave": "give", "given": "give", "went": "go", "gone": "go", "goes": "go", "grew": "grow",
    "grown": "grow", "heard": "hear", "hid": "hide", "hidden": "hide", "held": "hold", "kept": "keep", "knew": "know",
    "known": "know", "led": "lead", "left": "leave", "lent": "lend", "lay": "lie", "lain": "lie", "lost": "lose",
    "made": "make", "meant": "mean", "met": "meet", "overcame": "overcome", "overhung": "overhang", "paid": "pay",
    "ran": "run", "rang": "ring", "rose": "rise", "risen": "rise", "said": "say", "saw": "see", "seen": "see",
    "sent": "send", "shook": "shake", "shaken": "shake", "shone": "shine", "sang": "sing", "sat": "sit",
    "slept": "sleep", "slid": "slide", "spent": "spend", "spilt": "spill", "spoke": "speak", "stood": "stand",
    "stole": "steal", "stuck": "stick", "struck": "strike", "swept": "sweep", "swam": "swim", "swung": "swing",
    "took": "take", "taken": "take", "taught": "teach", "tore": "tear", "torn": "tear", "told": "tell",
    "thought": "think", "threw": "throw", "thrown": "throw", "understood": "understand", "withdrew": "withdraw",
    "woke": "wake", "has": "have", "had": "have", "wore": "wear", "worn": "wear", "wove": "weave", "woven": "weave",
    "won": "win", "wrote": "write",
    "written": "write", "lying": "lie", "dying": "die", "tying": "tie", "hung": "hang", "sunk": "sink",
}  # fmt: skip
_QUALITIES = _words("""
    endgame
    absence access accident accuracy ache action activity addition advantage advice aesthetic aftermath afternoon
    age aid aim air allure alternative ambiance ambience amount angle anticipation appeal appearance appetite
    approach aroma art aspect assistance atmosphere attempt attention attraction autumn average balance beauty
    beginning behavior behaviour benefit bit blend blur boundary bounds breeze brightness brilliance bulk business
    calm care caution centimeters challenge chance change chaos character characteristic charm chill choice
    circumstance clarity cleanliness clue clutter collision color colors colour colours combination comfort command
    comparison complexity concept concern condition confusion constraint contact context contour contrast control
    convenience coordination corner couple course craft craftsmanship creation creativity culture curiosity dance
    danger darkness dawn decay decision degree delicacy delight demand density depth design desire detail difference
    difficulty dimension direction disarray disorder distance disuse dive dominance doubt dust duration dusk ease
    effect effort elegance element emphasis encounter end energy enjoyment entirety environment essence evening
    event evidence example exception excess execution exercise experience experiment expression extent fact failure
    fall familiarity fashion feature feel feeling fervor finale finesse finish fit flair flavor flavour flow focus
    fog fold form foreground fragility fragrance frequency freshness fun function future gap gaze gesture glare
    glance gleam glint gloom gloss glow goal grace grain grandeur grasp gravity greenery ground guess guidance habit
    half happiness hardship harm harmony haste haze health heart heat heights help heritage hierarchy hint history
    hope hour hue hues idea identity illusion impact importance impression improvement indication indulgence
    influence information inspection instance instruction instructions intent intention interaction interest
    interplay interruption intimacy intricacy invitation issue job journey joy judgement judgment juxtaposition kind
    knowledge lack laughter layer layout lead leisure length lengths level lies life light lighting lightness
    likeness limit line lines location logic look looks loss love luck luminescence luster lustre luxury magic
    magnificence majesty manner mark marks mass matter maximum meaning means medium memory mess metaphor method
    midday middle midst mind minimum minute mist mixture mode moment mood moonlight morning motif motion movement
    mystery narrative nature necessity need neglect neighborhood night noise noon nostalgia note notion number
    occasion oddity odds opinion opportunity opposite option order organization orientation origin opulence outcome
    outlook overall pace pain palette part passage past path patience patina pattern pause peace perfection
    performance period perspective phase piece place placement play pleasure plenty point portion pose position
    photography possession possibility potential power practice practicality precaution precision preference preparation
    presence pressure prestige pride priority problem procedure process production progress prominence promise proof
    property proportion proportions prosperity protection proximity pull purity purpose push quality quantity
    question quiet radiance range rate ratio reach reality reason reference reflection refreshment regard region
    relationship relaxation relief reminder remnants repetition repose request requirement respect respite response
    result rhythm richness risk role romance routine ruggedness rule run rush safety sake sameness sanctuary
    satisfaction scale scenario scene scenery scent schedule seamlessness season section sensation sense serenity
    series setting setup shade shadow shadows shape shapes sheen shift shimmer shine show side sight sign significance
    signs silence silhouette similarity simplicity situation size sizes skill softness solution sort sound source
    space spaces sparkle spectacle speed spirit splash splendor spot stability stage stain stains stance start state
    statement status step steps stillness storm story strategy strength stress structure struggle style styles
    subject subtlety success suggestion summer sunbeam sunbeams sunlight sunrise sunset surface surfaces surprise
    surroundings symbol symbolism symmetry symphony system talent task taste teamwork technique temperature tendency
    tension territory test testament texture textures theme thickness thing thought threshold thrill time times
    togetherness tone tones touch trace traces tradition trail tranquility tranquillity transition transparency
    trial trick trouble truth turmoil twilight twist type types unity universe use utility vacancy value variation
    variety versatility vibe vibrancy vicinity view viewpoint virtue vision vitality void volume warmth wave way
    weather weight welcome whimsy whole width wind winter wisdom wish wonder work workmanship world worth
    yearning years youth zone trip party holiday vacation wedding celebration ceremony meeting lesson counterpart
    partner mate audience everyone everybody someone somebody anyone guest guests
""")  # fmt: skip
"""Nouns of what is no thing."""
_ENDINGS = ("tion", "sion", "ness", "ity", "ance", "ence", "ship", "ism", "hood", "ment")
_THINGS = _words("""
    ornament instrument equipment station carnation cushion document garment pavement basement apartment condiment
    ambulance fence monument parchment attachment compartment harness witness lioness city spaceship battleship ship
    warship airship medicament implement conveyance appliance supplement segment playstation decoration illustration
    invitation caution potion lotion television concoction chess entrance electricity cavity
""")  # fmt: skip
"""Things whose names end as those of qualities do."""
_LITTLE = _words("""
    farthest furthest nearest closest along amid parallel perpendicular straight gentle askew alike able about above
    accordingly across actually afterwards afterward again ago ahead akin alike almost alone already also although
    altogether always amidst anew any anymore anything anytime anyway anywhere apart around as aside asleep at away
    back bare barely based because before behind below besides best better between beyond both briefly but by
    certain consequently correct corresponding daily despite done down due during each early either elsewhere enough
    entire especially etc even eventually ever every everywhere evident exact extra far fast faster few finally
    first following for forth forward from fully further furthermore half hard hardly hence here high how however i
    if immediately in inside instead into its itself last later least less likewise little long longer low many may
    maybe me meanwhile might moreover most mostly much must my namely near nearby nearly necessary neither never
    nevertheless next no nonetheless normal nor not nothing now nowhere of off often on once only onto opposite or
    otherwise ought our out outside over overall own per perhaps please possible previous quick quickly quite rather
    ready respectively round same seldom several should since slow slowly so somehow somewhat somewhere soon still
    straight such sure than thank thanks that their them themselves then there thereby therefore these they this
    those though through throughout thus till to together too toward towards true twice until up upon upwards us
    usual various very via we well what whatever when whenever where whereas whereby wherein wherever whether while
    outward outwards inward inwards downward downwards upward everywhere sideways
    whilst who whole whom whose why will with within without would yet you your
""")  # fmt: skip
"""Words that build a sentence, beside those of the other tables."""
_DESCRIBING = ("ful", "ish", "ous", "ic", "ical", "able", "ible", "less", "ive", "ed", "ing", "ual", "ly", "ary")


@cache
def base_verb(word: str) -> str | None:
    """The verb of which `word` is a form, or None."""
    if word in _DOINGS:
        return word
    if word in _IRREGULAR:
        return _IRREGULAR[word]
    for ending, instead in (("ies", "y"), ("es", ""), ("s", ""), ("ied", "y"), ("ed", ""), ("ed", "e"), ("d", ""),
                            ("ing", ""), ("ing", "e")):  # fmt: skip
        if word.endswith(ending) and len(word) > len(ending) + 1:
            stem = word.removesuffix(ending) + instead
            doubled = stem[-1:] == stem[-2:-1] and ending in ("ed", "ing")
            found = next((each for each in (stem, stem[:-1] if doubled else stem) if each in _DOINGS), None)
            if found is not None:
                return found
    return None


@cache
def is_quality(word: str) -> bool:
    """Whether `word` names no thing but what something is like, or a place or a time."""
    forms = (word, *singulars(word))
    if any(form in _THINGS for form in forms):
        return False
    listed = any(form in _QUALITIES or form in lexicon.BACKGROUND for form in forms)
    return listed or any(form.endswith(_ENDINGS) for form in forms)


@cache
def is_no_noun(word: str) -> bool:
    """Whether `word` is listed as one that names no thing, and is no verb that may be a noun as well."""
    return word in _LITTLE or word in _IRREGULAR or any(form in _QUALITIES for form in (word, *singulars(word)))


@cache
def makes_nothing(word: str) -> bool:
    """Whether `word` names no thing at all, whatever the catalogue has."""
    tables = (_LITTLE, lexicon.DETERMINERS, lexicon.POSSESSIVES, lexicon.PRONOUNS, lexicon.COPULAS, lexicon.VERBS,
              lexicon.PARTICIPLES, lexicon.COMMANDS, lexicon.ADVERBS, lexicon.MOOD_VERBS, lexicon.STATES,
              lexicon.DIRECTIONS, lexicon.SAID_OTHERWISE, lexicon.SHADE_WORDS, lexicon.PARTS,
              lexicon.SUBSTANCES)  # fmt: skip
    part = any(form in lexicon.PARTS for form in singulars(word))
    told = any(word in table for table in tables) or part or base_verb(word) is not None or is_quality(word)
    return told or (word.endswith(_DESCRIBING) and not word.endswith("fly"))
