"""What figures share: panels, curves, maps, the look, captions, and the verdicts below them."""
