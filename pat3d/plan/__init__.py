"""From a sentence to a plan: which objects to make and what carries, holds or stands beside what."""
