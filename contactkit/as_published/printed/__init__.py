"""Equations exactly as printed, errata included.

common   The formulas of chapter 3 as printed, by equation number: for reproduction, never as defaul
errata   What is wrong with the equations of chapter 3, one sentence for each, for warnings and docs
films    More of chapter 3 as printed, by equation number: films, pressures, division, full occupati
sliding  The formulas of tangential separation as printed, by equation number: for reproduction only
viscous  The viscous formulas of chapter 3 as printed, by equation number; `published` is their door
"""
