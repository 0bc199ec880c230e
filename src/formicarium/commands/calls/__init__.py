"""What programs and notebooks call; ``import formicarium`` offers all of it."""
