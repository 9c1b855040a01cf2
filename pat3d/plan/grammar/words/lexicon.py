"""The planner's word tables: English that does not depend on what the catalogue can make."""

from __future__ import annotations

from pat3d.plan.grammar.words.generics import GENERICS as GENERICS
from pat3d.plan.grammar.words.generics import MASS_GENERICS as MASS_GENERICS
from pat3d.plan.grammar.words.parts import ENDS as ENDS
from pat3d.plan.grammar.words.parts import PARTS as PARTS
from pat3d.plan.holders import HOUSING as HOUSING

NUMBERS: dict[str, int] = {
    "zero": 0, "one": 1, "two": 2, "three": 3, "four": 4, "five": 5, "six": 6, "seven": 7, "eight": 8, "nine": 9,
    "ten": 10, "eleven": 11, "twelve": 12, "thirteen": 13, "fourteen": 14, "fifteen": 15, "sixteen": 16,
    "seventeen": 17, "eighteen": 18, "nineteen": 19, "twenty": 20, "thirty": 30, "forty": 40, "fifty": 50,
    "hundred": 100, "thousand": 1000, "both": 2, "single": 1, "couple": 2, "dozen": 12, "trio": 3,
}  # fmt: skip
VAGUE: dict[str, int] = {
    "few": 3, "some": 3, "several": 4, "multiple": 3, "various": 3, "many": 5, "numerous": 5, "couple": 2,
}  # fmt: skip
"""Quantities that name no number, and the number taken for them."""

BARE_PLURAL = 3
STACK_HEIGHT = 4
FILLING = 8
"""Objects placed for "mugs", in "a stack of books", and for "filled with balls"."""

PALETTE_COUNT = {"rainbow": 6, "warm": 3, "cool": 3}
COLOURFUL_COUNT = 4
"""Objects placed for "rainbow macarons" and for any other word of many colours, when the prompt gives no number."""

COMES_IN_TWOS = frozenset({"bedside table", "nightstand", "shoe", "slipper", "boot", "sock", "candlestick"})

SIZES: dict[str, float] = {
    "tiny": 0.5, "miniature": 0.6, "mini": 0.6, "baby": 0.7, "small": 0.75, "little": 0.75,
    "medium": 1.0, "medium-sized": 1.0, "large": 1.3, "big": 1.3, "oversized": 1.5, "huge": 1.6, "giant": 1.8,
    "enormous": 1.8, "massive": 1.8, "bigger": 1.3, "larger": 1.3, "smaller": 0.75,
}  # fmt: skip

SHADES: dict[tuple[str, str], str] = {
    ("dark", "blue"): "navy", ("dark", "brown"): "chocolate", ("dark", "red"): "maroon", ("light", "brown"): "tan",
    ("light", "blue"): "cyan", ("light", "green"): "mint", ("light", "purple"): "lavender",
    ("light", "yellow"): "cream", ("light", "orange"): "peach", ("light", "pink"): "pink",
}  # fmt: skip
SHADE_WORDS = frozenset({"dark", "light", "pale", "bright", "deep", "soft", "warm", "cool", "rich", "muted"})

DETERMINERS = frozenset({"a", "an", "the", "this", "that", "these", "those", "another", "each", "every", "any", "all"})
DEFINITE = frozenset({"the", "this", "that", "these", "those", "each", "every", "both", "all", "any"})
DEMONSTRATIVES = frozenset({"that", "this"})
"""Pronouns for what was named last."""
POSSESSIVES = frozenset({"its", "his", "her", "their", "my", "your", "our"})
LEADING = DETERMINERS | POSSESSIVES | NUMBERS.keys() | VAGUE.keys()
COUNTING = NUMBERS.keys() | {"a", "an"}
PRONOUNS = frozenset({"it", "them", "they", "him", "he", "she", "itself", "themselves", "which"})

RELATIVES = frozenset({"that", "which", "who", "whose", "where"})
"""Words that open a clause about the noun before them."""

COPULAS = frozenset({"is", "are", "was", "were", "be", "being", "'s", "looks", "look", "appears", "appear"})
VERBS = frozenset({"sits", "sit", "stands", "stand", "rests", "rest", "lies", "lie", "lays", "lay", "leans", "lean",
    "perches", "sat", "stood", "rested", "laid", "leaned", "hung", "perched", "stayed", "belongs", "sleeps", "floats",
    "goes", "stays", "hangs", "waits", "balances", "crouches", "poses", "swims", "plays", "belong", "sleep", "float",
    "perch", "crouch", "stay", "remain", "remains", "hides", "hide", "lurks", "lurk", "slumps", "lounges", "reclines",
    "exists", "exist", "sprawls", "dozes", "nestles", "nestle", "huddles", "huddle", "rises", "wait",
    "looms"})  # fmt: skip
"""Finite verbs of posture: what follows relates to the subject of the clause."""
NOUNS_LIKE_VERBS = frozenset({"stand"})
"""Verbs of posture whose plural is a noun too."""
PARTICIPLES = frozenset({"sitting", "standing", "resting", "lying", "laying", "leaning", "perched", "perching",
    "placed", "balanced", "balancing", "positioned", "located", "arranged", "displayed", "set", "seated", "situated",
    "nestled", "wedged", "stuck", "squeezed", "nestling", "planted", "served", "shown", "seen", "visible", "parked",
    "strewn", "lined", "sprawled", "tossed", "cast", "propped", "laid", "floating", "sleeping", "scattered", "left",
    "hanging", "mounted", "spread", "kept", "stored", "tucked", "put", "facing", "crouching", "kneeling", "waiting",
    "posing", "dropped", "organised", "organized", "grouped"})  # fmt: skip
OF_SEVERAL = frozenset({"are", "were", "sit", "stand", "lie", "rest", "hang", "lean", "have", "hold", "contain"})
"""Finite verbs of several things."""
NOT_VERBS = frozenset({"painting", "pudding", "ring", "earring", "string", "king", "railing", "clothing", "stocking",
    "wing", "spring", "building", "ceiling", "dressing", "icing", "bed", "seed", "shed", "weed", "sled", "thing",
    "pedding", "bedding", "dumpling", "duckling", "sling", "swing", "wedding", "lightning", "led", "sibling",
    "figuring", "keyring", "herring", "tubing", "daybed", "airbed", "legging"})  # fmt: skip
"""Words that end like a participle and are nouns."""
COMMANDS = frozenset({"place", "put", "create", "generate", "make", "show", "arrange", "add", "build", "draw",
    "imagine", "please", "render", "depict", "i", "i'd", "we", "you", "want", "need", "would", "like", "can", "see",
    "me", "let", "us", "design", "then", "also", "now", "next", "finally", "just", "only", "there's", "here", "who",
    "that", "while", "set", "scene:", "visualize", "picture", "give", "have"})  # fmt: skip
"""Words that may open a clause and mean nothing for the scene."""
MOOD_VERBS = frozenset({"creating", "giving", "adding", "evoking", "conveying", "making", "casting", "producing",
    "bathed", "illuminated", "lit", "captured", "rendered", "photographed", "shot", "depicted", "painted",
    "emphasizing", "highlighting", "evokes", "creates", "adds", "gives", "conveys", "enhancing", "complementing",
    "forming", "casts", "reflects", "reflecting", "gleams", "gleaming", "glows", "glowing", "glistens", "glistening",
    "shimmers", "shimmering", "shines", "contrasts", "contrasting", "complements", "accentuates", "accentuating",
    "emphasizes", "highlights", "enhances", "exudes", "radiates", "reveals", "revealing", "suggests", "suggesting",
    "hinting", "indicating", "exhibits", "evoked", "lending", "lends", "providing", "provides", "offering", "offers",
    "emitting", "emits", "inviting", "invites", "completing"})  # fmt: skip
"""Verbs that begin a remark about light, mood or camera: set aside up to the end of the sentence."""
STANDING = COPULAS | VERBS
"""Verbs that say where or how a thing is."""
MODALS = frozenset({"should", "must", "shall", "will", "can", "could", "may", "might", "would"})

ADVERBS = frozenset({"very", "neatly", "quite", "really", "slightly", "carefully", "directly", "right", "just",
    "immediately", "entirely", "vertically", "horizontally", "upright", "loosely", "closely", "together", "nicely",
    "partially", "too", "so", "still", "precariously", "gently", "randomly", "evenly", "happily", "also", "comfortably",
    "currently", "up", "down", "neat", "already", "everywhere"})  # fmt: skip

BACKGROUND = frozenset({"room", "setup", "set-up", "scene", "background", "backdrop", "composition", "perspective",
    "view", "floor", "ground", "surface", "wall", "walls", "atmosphere", "style", "environment", "bedroom", "kitchen",
    "bathroom", "office", "garden", "studio", "photo", "photograph", "image", "camera", "angle", "rendering", "render",
    "illustration", "sunlight", "lighting", "shadow", "shadows", "mood", "tone", "tones", "palette", "morning",
    "evening", "night", "day", "afternoon", "ceiling", "window", "outdoors", "indoors", "space", "area", "interior",
    "vibe", "feel", "aesthetic", "setting", "layout", "display", "arrangement", "front-view", "viewpoint", "shot",
    "closeup", "close-up", "grass", "lawn", "field", "beach", "sand", "park", "forest", "street", "house", "home",
    "nursery", "playroom", "classroom", "workshop", "garage", "library", "cafe", "restaurant", "shop", "sky", "wind",
    "quality", "resolution", "detail", "details", "workspace", "world", "corner", "tabletop scene", "still life",
    "living room", "dining room", "carpeted floor", "countertop scene", "foreground", "sun", "moonlight", "light",
    "hallway", "sill", "windowsill", "doorway", "wallpaper", "curtain", "curtains", "lounge", "study", "den", "loft",
    "workcell", "attic", "basement", "lobby", "parlour", "parlor", "salon", "sunroom", "apartment", "courtyard",
    "porch", "veranda", "pavement", "sidewalk", "meadow", "gallery", "museum", "bakery", "yard", "backyard", "patio",
    "terrace", "balcony", "campsite", "campground", "camp", "alley", "plaza", "farm", "barn", "stable", "harbour",
    "harbor", "shore", "riverside", "warehouse", "factory", "store", "supermarket", "market", "school", "hospital",
    "hotel", "lab", "laboratory", "cellar", "driveway", "playground", "roadside", "cafeteria", "pantry", "entryway",
    "foyer", "lakeside", "countryside", "sunshine", "nighttime", "daytime", "daylight", "dusk", "dawn", "sunset",
    "sunrise", "midnight", "noon", "ambiance", "ambience", "observer", "viewer", "gym", "gymnasium", "shed",
    "pair view", "suite", "total", "sight", "time", "place", "contrast", "focus", "motion", "condition", "orientation",
    "direction", "user", "manner", "way", "fashion", "use", "close up", "grain patterns", "windows",
    "staircase", "staircases", "stairs", "stairway", "stairwell",
    "nook", "alcove", "kitchenette", "bistro", "diner", "boutique", "atelier", "conservatory", "cubicle"})  # fmt: skip
"""Heads of phrases about place, camera and mood: recognised, set aside, never placed."""
ITEMS = frozenset({"following", "items", "item", "objects", "object", "things", "everything", "all", "contents",
    "elements"})  # fmt: skip
CUT_INTO = frozenset({"half", "halves", "two", "three", "four", "many", "several", "thin", "small", "thick", "quarters",
    "pieces", "slices", "wedges", "rounds", "cubes", "rings", "strips", "chunks", "bits"})  # fmt: skip
"""What things are cut into."""
PIECES = frozenset({"piece", "pieces", "ones", "one", "colours", "colors", "shades", "units", "members", "hues"})
PLACES = frozenset({"left", "right", "leftmost", "rightmost", "middle", "first", "second", "third", "last"})
"""Words that tell one of several by its place: "the left one"."""
MAIN_PARTS = frozenset({"cover", "fur", "texture", "finish", "design", "pattern", "body", "frame", "shade", "petal",
    "surface", "top", "icing", "frosting", "print", "leaf", "spine", "tabletop", "mattress", "head", "skin",
    "exterior", "peel", "rind", "shell"})  # fmt: skip
"""Parts whose colour is the colour of the whole."""

STACK_NOUNS = frozenset({"stack", "pile", "tower", "column", "heap", "mound"})
HEAPS = frozenset({"heap", "mound"})
TOWERS = STACK_NOUNS - HEAPS
"""What is never a stack, whatever lies in it; a pile of what rolls is none either."""
DRAWERS = frozenset({"drawer", "drawers", "compartment", "compartments", "door"})
"""Parts that things are put into and no asset has."""
COLLECTIVES = frozenset({"set", "collection", "group", "bunch", "assortment", "variety", "array", "number", "handful",
    "lot", "lots", "selection", "mix", "mixture", "cluster", "arrangement", "range", "plenty", "couple", "few", "trio",
    "dozen", "dozens", "pair", "pairs", "sets", "groups", "bunches", "collections", "clusters", "kind", "type",
    "kinds", "types", "bit", "series", "bundle", "bundles", "batch", "spectrum", "bushel", "crowd", "host",
    "smattering", "scattering", "flock", "herd", "swarm", "bouquet", "bouquets", "posy"})  # fmt: skip
ALIKE_IN_PLURAL = frozenset({"sheep", "fish", "deer"})
"""Nouns of which the plural is no other word: "a herd of sheep"."""
ROWS = frozenset({"row", "line"})
PORTIONS = frozenset({"bar", "piece", "slice", "loaf", "chunk", "sheet", "tube", "stick", "roll", "pack", "packet",
    "wedge", "head", "scoop", "carton", "can", "tin", "bottle", "box"})  # fmt: skip
"""X in "X of Y" where X only portions Y."""
SHAPES = frozenset({"figure", "statue", "figurine", "sculpture", "toy", "model", "block", "ball"})
"""X in "X of Y" where X is the form that Y has."""
PICTURES = frozenset({"photo", "photograph", "picture", "image", "view", "shot", "rendering", "render", "illustration",
    "display", "scene", "arrangement", "painting", "drawing", "depiction", "sketch", "watercolor",
    "watercolour", "artwork", "cartoon", "diorama", "snapshot",})  # fmt: skip
"""X in "X of Y" where only Y is there to be placed."""
STYLES = frozenset({"4k", "8k", "16k", "hd", "uhd", "hdr", "octane", "artstation", "unreal", "engine", "cgi", "bokeh",
    "masterpiece", "photorealism", "hyperrealism", "photoreal", "3d", "render", "rendering", "style", "quality",
    "resolution", "lighting", "pbr", "pixar", "ghibli"})  # fmt: skip
"""Words for how a picture is made, set off behind its scene."""
SUBSTANCES = frozenset({"water", "tea", "coffee", "milk", "juice", "wine", "beer", "soup", "rice", "sugar", "salt",
    "honey", "jam", "oil", "sauce", "cereal", "flour", "sand", "soil", "dirt", "ink", "paint", "cream", "lemonade",
    "soda", "chocolate milk", "peelings", "shavings", "sawdust", "crumbs",
    "steam", "liquid", "ice", "gel", "cocoa", "syrup", "butter", "tissues", "paper",
    "beverage", "greens", "lentil", "broth", "whisky", "whiskey", "rum", "vodka", "gin", "tequila", "brandy", "bourbon",
    "champagne", "cider", "liqueur", "sherry", "sake", "espresso", "latte", "cappuccino", "matcha", "batter", "dough",
    "gravy", "stew", "porridge", "oatmeal", "oats", "curry", "ramen", "quinoa", "couscous", "bean", "chickpea",
    "sprinkles", "jelly", "marmalade", "chutney", "salsa", "guacamole", "crumb", "breadcrumb", "leftovers", "scraps",
    "basil", "herb", "parsley", "rosemary", "thyme", "cilantro", "oregano", "dill", "sage", "mint", "foam", "froth",
    "lather", "suds", "bubbles", "puddle", "snow", "mud", "gravel", "cement", "plaster", "compost", "mulch", "hay",
    "lint", "ash", "ashes", "smoke", "gasoline", "petrol", "fuel", "varnish", "confetti", "glitter",
    "potpourri", "junk", "debris", "trinkets", "foil", "fabric", "wrapping", "tinsel", "seeds", "kibble",
    "birdseed"})  # fmt: skip
"""Contents too fine or too wet to be rigid bodies, what covers things, and what is of no one kind."""

PLURAL_ONLY = frozenset({"scissors", "glasses", "sunglasses", "eyeglasses", "pliers", "tongs", "tweezers", "headphones",
    "earbuds", "earphones",
    "pants", "jeans", "shorts", "trousers", "binoculars", "goggles", "clippers", "pajamas", "shears"})  # fmt: skip
"""One object with a plural name; "a pair of" them is one."""

BUNCHES = frozenset({"grapes", "flowers", "bread", "toast", "cheese", "lettuce", "broccoli", "celery", "garlic"})
"""Names of one object that are said of an amount: "some grapes" are a bunch, "some bread" is a loaf."""

FLOOR = ("bed", "bedside table", "bookshelf", "sofa", "coffee table", "table", "desk", "rug", "chair", "side table",
    "shelf", "cart", "inflatable pool", "tree", "armchair", "bench", "cabinet", "dresser", "wardrobe", "ottoman",
    "floor lamp", "rocking chair", "tv stand", "swing", "crib", "counter", "stove", "fridge", "washing machine",
    "bathtub", "stool", "wizard", "futon", "piano", "floor cushion", "kitchen island", "workbench", "sink",
    "dishwasher", "dryer", "ironing board", "conveyor belt", "pallet", "yoga mat", "parasol", "coat stand",
    "towel rail", "toilet", "radiator", "fireplace", "grill", "vacuum cleaner", "robot vacuum", "sawhorse",
    "umbrella stand", "plant stand", "bicycle", "open fridge", "open oven", "open dishwasher", "open cabinet",
    "open wardrobe")  # fmt: skip
"""Things that stand on the floor: a list never puts them on a table, and nothing passes its own support to them."""
LEVEL = ("table", "desk", "coffee table", "side table", "bedside table", "shelf", "bookshelf", "counter", "cabinet",
    "dresser", "bench", "tray", "cart", "rug", "tv stand", "workbench", "cutting board", "wardrobe", "ottoman", "stool",
    "placemat", "kitchen island", "stove", "washing machine", "ironing board", "conveyor belt", "chessboard", "pallet",
    "plant stand", "fireplace", "grill", "radiator", "toilet", "blotter", "sawhorse", "file sorter", "open cabinet",
    "open wardrobe", "open oven")  # fmt: skip
SEATS = ("bed", "sofa", "couch", "chair", "armchair", "bench", "pillow", "cushion", "floor cushion", "blanket")
DISHES = ("plate", "saucer", "platter", "cake stand", "coaster", "soap dish", "tray", "cutting board", "placemat",
          "baking tray", "trivet")  # fmt: skip
"""What carries things on top: "in", "with", "holding" and "of" mean "on" there (soap dishes have a hollow: "in")."""
FRUIT = ("fruit", "apple", "orange", "lemon", "lime", "pear", "peach", "plum", "cherry", "strawberry", "watermelon",
    "banana", "pineapple", "grapes", "grape", "mango", "kiwi", "avocado", "pomegranate", "coconut", "fig",
    "melon")  # fmt: skip
HOUSES = {"microwave": "open microwave", "toaster oven": "open toaster oven", "stove": "open oven",
          "fridge": "open fridge", "dishwasher": "open dishwasher", "cabinet": "open cabinet",
          "wardrobe": "open wardrobe"}  # fmt: skip
"""What a closed thing that opens in front becomes when something is put in it: other things may stand on it."""
TIERS = {"bookshelf": 4, "shelf": 4, "cart": 2, "coffee table": 2, "side table": 2, "workbench": 2, "tv stand": 2,
         "stove": 2, "open oven": 2, "fridge": 3, "open fridge": 3, "dishwasher": 2, "open dishwasher": 2,
         "cabinet": 2, "open cabinet": 2, "wardrobe": 4, "open wardrobe": 4}  # fmt: skip
"""What has several boards or compartments to put things on, and how many."""
STACKED = ("bookshelf", "shelf")
"""What has as many of them as is said."""
ROUND = ("ball", "apple", "orange", "lemon", "lime", "peach", "plum", "cherry", "egg", "tomato", "watermelon", "kiwi",
    "crystal ball", "tennis ball", "basketball", "football", "soccer ball", "marble", "potato", "onion", "pear",
    "avocado", "grapefruit", "melon", "coconut", "pumpkin", "baseball", "globe", "sphere", "ball of yarn",
    "olive")  # fmt: skip
"""What rolls: a pile of it is no stack."""
SOLID = (*ROUND, "block", "cube", "cylinder", "cone", "brick", "cheese", "book", "notebook", "laptop", "stone",
    "candle", "cake", "bread", "soap", "sponge", "phone")  # fmt: skip
"""What nothing is in, whatever is said."""
LYING = ("book", "notebook", "magazine", "laptop", "tablet", "phone", "smartphone", "plate", "saucer", "coaster",
    "tray", "cutting board", "board", "plank", "pen", "pencil", "fork", "knife", "spoon", "ruler", "scissors", "hammer",
    "screwdriver", "wrench", "pillow", "cushion", "towel", "rug", "mat", "placemat", "napkin", "cardboard sheet",
    "pizza", "cookie", "pancake", "keyboard", "remote control", "brick", "toothbrush", "razor", "comb", "newspaper",
    "envelope", "umbrella", "guitar", "kite", "tile", "ticket", "vinyl record", "blotter")  # fmt: skip
"""What lies as the catalogue makes it: "upright" says something of it that the scene does not have."""
ON_EDGE = ("book", "notebook", "magazine", "phone", "smartphone", "tablet", "brick", "cutting board", "plank",
    "domino", "tile", "vinyl record")  # fmt: skip
"""What lies and can stand on its edge: "upright" and "on end" say that of it."""
BOUND = ("book", "notebook", "spell book", "binder")
SHELVES = ("shelf", "bookshelf", "bookcase", "shelving unit")
"""What people have standing, where it is in a row: on what."""
NOT_ON_DISH = ("vase", "mug", "cup", "glass", "lamp", "book", "plate", "bowl", "teapot", "bottle", "pot", "basket",
    "radio", "laptop", "clock", "kettle", "plant", "potted plant", "jar", "box", "candle", "pitcher",
    "tray")  # fmt: skip
THIN = ("rug", "mat", "placemat", "tray", "plate", "saucer", "coaster", "carpet", "blanket", "book", "cardboard sheet",
        "cutting board", "table", "towel", "napkin", "pillow", "cushion", "yoga mat", "mouse pad",
        "trivet", "chessboard", "blotter", "tile", "jigsaw puzzle", "newspaper")  # fmt: skip
"""What can lie under something: "a rug under a table" puts the table on the rug."""
STACKABLE = ("block", "box", "brick", "cube", "bowl", "crate", "can", "storage box", "wooden block", "dice", "cake")
"""What else is below rather than beside what it is "under", where that does not stand on the floor."""
HANGING = frozenset({"hangs", "hang", "hanging", "hung", "suspended", "dangling", "dangles"})
OVERHANGING = ("table", "desk", "coffee table", "side table", "dining table", "workbench", "bench", "chair", "stool",
    "bed", "ping pong table", "picnic table", "ironing board", "shelf", "cart", "trolley", "sawhorse",
    "plant stand")  # fmt: skip
"""What stands on legs, so that things can stand below it."""
BOUGHS = ("tree", "rod")
"""What something is below rather than below the bird on it; a branch is made as a rod."""
MAIN_DISHES = ("burger", "sandwich", "steak", "fish", "hot dog", "sausage", "pizza", "burrito")
SIDE_DISHES = ("french fries", "potato", "corn", "broccoli", "carrot", "chip bag")
"""What lies beside a main dish that is "with" it."""
LONG = ("plank", "board", "wooden board", "ruler", "ladder", "stick", "rod", "beam", "log")
"""What is on two things by lying across them."""
ON_HEAD = ("hat", "cap", "crown", "top hat", "party hat", "helmet", "bowler hat", "cowboy hat", "wizard hat", "beanie")
WORN = (*ON_HEAD, "t-shirt", "coat", "scarf", "sunglasses", "mitten", "apron", "backpack")
"""What a figure has on, though it may lie anywhere."""
STORAGE = ("bookshelf", "bookcase", "shelf", "shelving unit", "cabinet", "dresser", "wardrobe", "cart", "desk",
    *HOUSING)  # fmt: skip
STORAGE_PARTS = frozenset({"shelf", "shelves", "drawer", "drawers"})
"""Parts of storage furniture that are also nouns of their own: "the shelf" of a bookcase is no second object."""
LAID = frozenset({"runner", "table runner", "tablecloth", "table cloth", "placemat", "place mat", "centerpiece",
    "centrepiece", "doily"})  # fmt: skip
"""What tables are laid with, by what it is called."""
ON_WALLS = ("wall clock", "hook rail", "towel rail", "key rack")
"""What hangs on a wall though a list of it ends in "on the table"."""
BY_A_SEAT = ("lamp", "plant", "potted plant", "vase", "basket", "fire extinguisher", "ball", "swing", "clock")
"""What stands beside a sofa rather than on it when the prompt only says "next to"."""

DEVICES = ("laptop", "computer", "keyboard", "monitor", "tablet", "phone", "television")
"""What other things are with that stand beside it: "a laptop with a mouse"."""
HOOKED = ("mug tree", "hook", "hook rail", "key rack", "coat stand", "towel rail", "headphone stand")
"""What things hang on that are "on" it, "over" it or "in" it."""
FIGURES = ("statue", "doll", "teddy bear", "robot", "dog", "cat", "rabbit", "wizard", "snowman", "garden gnome")
"""What may hold something in its hands or mouth."""
BACKED = ("elephant", "giraffe", "turtle", "dog", "cat", "rabbit", "panda", "horse", "cow", "pig", "sheep", "dinosaur",
          "frog", "lion", "bird", "duck", "plush dog", "teddy bear")  # fmt: skip
"""Animals: what is "on the back of" one is on top of it."""
SILENT_PARTS = frozenset({"top", "surface", "base", "body", "finish", "texture", "color", "colour"})
"""Parts that every object has: to name them says nothing."""
DETACHED = frozenset({"lid", "cap", "cover", "handle", "drawer", "door", "knob", "drawers", "doors", "shelf", "button"})
"""Parts with a name that is a thing's too: "the lid of the box" is the box."""
FITTED = frozenset({"rack", "racks", "tray", "seat", "basket"})
"""Parts of furniture and appliances that are also things of their own."""
GREETINGS = frozenset({"hey", "hi", "hello", "ok", "okay", "alright", "dear", "so", "well", "now", "right", "listen",
    "great", "perfect", "excellent", "wonderful", "awesome", "fantastic"})  # fmt: skip
VIEWERS = frozenset({"you", "me", "us", "viewer", "observer", "onlooker", "robot", "camera"})
DIRECTIONS = frozenset({"forward", "forwards", "backward", "backwards", "closer", "further", "nearer", "farther",
    "clockwise", "counterclockwise", "sideways"})  # fmt: skip
YOUNG = frozenset({"kitten", "kitty", "puppy", "pup", "piglet", "lamb", "duckling"})
"""Words for young animals, which are made smaller."""
HONOURED = frozenset({"open", "opened", "closed", "shut", "square", "cubic", "flat", "tall", "long", "rectangular",
    "striped", "high", "deep", "short", "shallow", "low", "wide", "narrow", "baby", "young", "newborn", "lit",
    "burning", "flickering", "thin", "slim", "thick", "heavy", "round", "landscape", "kitten"})  # fmt: skip
"""Adjectives that recipes of the catalogue make something of."""
SAID_OTHERWISE = frozenset({"other", "same", "different", "another", "single", "own", "more", "left", "right", "middle",
    "first", "second", "third", "fourth", "fifth", "last", "leftmost", "rightmost", "front", "back", "alternating",
    "stacked", "of", "smallest", "largest", "biggest", "smaller", "larger", "bigger", "center", "centre", "normal",
    "regular", "standard", "ordinary", "typical", "real", "whole", "colored", "coloured", "matching", "identical",
    "potted", "plush", "stuffed"})  # fmt: skip
"""Adjectives that tell which, or say nothing."""
PILES = ("book", "plate", "saucer", "box", "brick", "block", "towel", "magazine", "newspaper", "pancake", "notebook",
         "envelope", "cardboard sheet", "plank", "cushion", "pillow", "tray", "blanket", "cutting board", "bowl",
         "cup", "crate", "t-shirt", "jeans", "waffle", "stack of paper", "placemat", "napkin", "tile", "ticket",
    "vinyl record", "jigsaw puzzle", "apron")  # fmt: skip
"""What a pile of is a stack."""
MEALS = frozenset({"breakfast", "lunch", "dinner", "supper", "meal", "stuff", "clutter", "mess",
    "brunch", "picnic", "dessert", "feast", "salad", "groceries"})  # fmt: skip
"""Words that name no single thing."""
FOREIGN = frozenset({"una", "el", "los", "las", "sobre", "con", "junto", "del", "unos", "mesa", "taza", "der", "das",
    "auf", "dem", "ein", "eine", "einen", "einem", "und", "mit", "neben", "tisch", "le", "les", "des", "une", "sur",
    "avec", "et", "dans", "il", "uno", "della", "sul", "tavolo", "een", "op", "het", "naast", "um", "uma", "em", "com",
    "na", "och", "ett", "przy", "jest"})  # fmt: skip
"""Function words of other languages."""
STATES = frozenset({"broken", "hidden", "cut", "torn", "worn", "bent", "frozen", "shut", "split", "chipped", "cracked",
    "burnt", "eaten", "bitten", "written", "painted", "wrapped", "folded", "filled", "covered", "sliced", "chopped",
    "plugged", "ready", "visible", "used", "unused", "missing", "damaged", "ajar", "lit", "closed"})  # fmt: skip
"""Words after a noun that say what has become of it."""
SUPERLATIVES = {
    "smallest": ("small", 0.75), "largest": ("large", 1.3), "biggest": ("big", 1.3), "tallest": ("tall", 1.0),
    "shortest": ("short", 1.0), "littlest": ("little", 0.75), "smaller": ("smaller", 0.75),
    "larger": ("larger", 1.3), "bigger": ("bigger", 1.3), "taller": ("tall", 1.0), "shorter": ("short", 1.0),
    "thickest": ("thick", 1.0), "thinnest": ("thin", 1.0), "longest": ("long", 1.0), "widest": ("wide", 1.0),
    "heavier": ("heavy", 1.0), "heaviest": ("heavy", 1.0), "lightest": ("light", 1.0),
    "thicker": ("thick", 1.0), "thinner": ("thin", 1.0), "longer": ("long", 1.0), "wider": ("wide", 1.0),
}  # fmt: skip
OPPOSITES = tuple(frozenset(pair.split()) for pair in (
    "dirty clean", "full empty", "open closed", "heavy light", "old new", "tall short", "long short", "wide narrow",
    "thick thin", "soft hard", "wet dry", "round square", "hot cold", "broken intact", "ripe unripe", "deep shallow",
    "filled empty", "used unused", "folded unfolded", "sharp blunt", "smooth rough", "opened closed", "hot iced",
))  # fmt: skip
"""Looks of which a thing has one."""
PARTS_OF: dict[str, tuple[str, ...]] = {
    "burner": ("stove",), "oven": ("stove",), "scoop": ("ladle", "spoon", "measuring spoon"),
    "bowl": ("spoon", "ladle", "measuring spoon", "wooden spoon"), "screen": ("laptop", "phone", "tablet", "monitor"),
    "keyboard": ("laptop",), "lid": ("laptop", "piano", "grill", "toilet", "printer", "treasure chest", "bin"),
    "clip": ("clipboard", "pen"), "cap": ("bottle", "pen", "marker"), "ring": ("binder",),
    "basket": ("shopping cart", "bicycle"), "mirror": ("dresser", "vanity"), "cord": ("lamp", "kettle", "toaster"),
    "stand": ("globe", "monitor"), "flower": ("plant", "potted plant", "cactus", "tree", "bush"),
    **dict.fromkeys(("mantelpiece", "mantel", "mantle", "hearth"), ("fireplace",)),
    "toilet seat": ("toilet",), "faucet": ("sink", "bathtub"),
}  # fmt: skip
"""What the things after it have as a part, though there are things of that name too."""
BUILT_IN = frozenset({"burner", "mantelpiece", "mantel", "mantle", "hearth"})
"""Those of which "the burner" is one wherever there is what has it."""
POSITIONS: dict[str, int] = {
    "left": 0, "leftmost": 0, "first": 0, "front": 0, "middle": 1, "right": -1, "rightmost": -1, "last": -1,
    "second": 1, "third": 2, "fourth": 3, "fifth": 4, "back": -1, "center": 1, "centre": 1,
}  # fmt: skip
"""Words for one of several by its place, and its index."""
LEVELS: dict[str, int] = {
    "bottom": 0, "lower": 0, "lowest": 0, "lowermost": 0, "bottommost": 0, "top": -1, "upper": -1, "uppermost": -1,
    "topmost": -1, "highest": -1,
}  # fmt: skip
"""Words for one of a stack by its height, and its index."""
BENEATH_CUPS = ("saucer", "coaster")
"""What a cup "with" it stands on."""
TELLING = frozenset({*POSITIONS, *LEVELS, *SUPERLATIVES})
"""Words before "one" that tell it from its like."""

HAVING = frozenset({"with", "has", "have", "holds", "hold", "holding", "contains", "contain", "containing", "carries"})
"""Words after which a list is of what something has."""
